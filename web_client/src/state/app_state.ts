import { computed, signal } from "@preact/signals";
import type { Codec, Pace, Timings } from "../net/gen/volcast/v1/frame_pb";
import type { Layer, RayModel, Scene } from "../net/gen/volcast/v1/scene_pb";
import type {
  DatasetInfo,
  FieldInfo,
  Person,
  Picked,
  Plan,
  Role,
  ViewState,
  Welcome,
} from "../net/gen/volcast/v1/session_pb";
import type { Apart } from "../transfer/apart";
import { referenceLengthOf } from "../transfer/opacity";
import type { TransferFunction } from "../transfer/transfer_function";
import type { Bounds, Orbit } from "../view/camera";
import type { HoverPlace } from "../view/hover";
import { length, subtract, type Vec3 } from "../view/vec3";
import type { Measured } from "./accuracy";
import type { Difference } from "./difference";
import { type History, startHistory } from "./history";
import type { ModelThumbnail } from "./model_thumbnails";
import type { Pins } from "./pins";
import type { Recording } from "./recording";
import type { Sample } from "./samples";
import type { DescribedCode } from "./shader_actions";
import { kUsualPlaying, type Playing } from "./time_steps";
import type { Upload } from "./upload";
import { kUsualOptions, type ViewOptions } from "./view_options";

export type ConnectionStatus =
  | { readonly kind: "connecting" }
  | { readonly kind: "open" }
  | { readonly kind: "lost"; readonly retryAt: number; readonly reason: string };

/** The picture on the screen. */
export interface PictureInfo {
  readonly view: number;
  readonly inputSeq: bigint;
  readonly width: number;
  readonly height: number;
  readonly codec: Codec;
  readonly lossless: boolean;
  readonly final: boolean;
  /** False: parts of a large volume are coarser than asked for, as long as finer ones are loaded. */
  readonly ready: boolean;
  readonly integrators: readonly string[];
  readonly workerGeneration: number;
  readonly timings: Timings | undefined;
  /** What the server decided about pictures to this client, and why. */
  readonly pace?: Pace | undefined;
  readonly bytes: number;
  readonly decodeMs: number;
  /** Of a lossless picture: the hash of its pixels is the server's; undefined: it cannot be told. */
  readonly exact?: boolean | undefined;
}

/** The transfer function as it is edited; what is drawn has its extinction times `density`. */
export interface MapEdit {
  readonly map: TransferFunction;
  readonly density: number;
  /** Opacities over this length follow a spline towards the points; absent: straight extinction. */
  readonly smooth?: number | undefined;
  /** Colours and opacities are edited by points of their own; `map` is both, joined. */
  readonly apart?: Apart | undefined;
}

/** The maps of the first layer: of its field, and of its second field where it has one. */
export interface Maps extends MapEdit {
  readonly second?: MapEdit | undefined;
}

/** All that undo goes back over: everything but the camera. */
export interface Edit extends Maps {
  /** Its camera, and the maps of its first layer, are replaced when it is sent. */
  readonly scene: Scene | undefined;
}

/** An update that the server refused; what it drew before stays. */
export interface Refusal {
  readonly inputSeq: bigint;
  /** Path in the scene: `layers[0].levels.count`; may be empty. */
  readonly field: string;
  readonly message: string;
}

/** A sentence for the user that waits until it is read. */
export interface Notice {
  readonly id: number;
  readonly kind: "error" | "info";
  readonly text: string;
}

/** One's place in a view. */
export interface Seat {
  /** The view's name in the server. */
  readonly id: string;
  readonly role: Role;
  /** The link that it was joined by; undefined: the view was opened here. */
  readonly link: string | undefined;
}

/** A link that joins a view. */
export interface ShareLink {
  readonly role: Role;
  readonly link: string;
  /** When it stops working: Unix time, s. */
  readonly expires: number;
}

export interface Steps {
  readonly canUndo: boolean;
  readonly canRedo: boolean;
}

export interface ViewportSize {
  readonly width: number;
  readonly height: number;
}

const point = (v: { x: number; y: number; z: number } | undefined): Vec3 =>
  v ? [v.x, v.y, v.z] : [0, 0, 0];

/** What all views of a page have in common. */
export function createSharedState() {
  return {
    connection: signal<ConnectionStatus>({ kind: "connecting" }),
    welcome: signal<Welcome | undefined>(undefined),
    datasets: signal<readonly DatasetInfo[]>([]),
    /** Files that are being sent, or were refused. */
    upload: signal<Upload | undefined>(undefined),
    options: signal<ViewOptions>(kUsualOptions),
    notices: signal<readonly Notice[]>([]),
  };
}

export type SharedState = ReturnType<typeof createSharedState>;

/** Everything the parts of one view share. They read and write these signals and do not know each other. */
export function createAppState(shared: SharedState = createSharedState()) {
  const { datasets } = shared;
  const edit = signal<History<Edit>>(
    startHistory({ map: [], density: 1, second: undefined, scene: undefined }),
  );
  const scene = computed<Scene | undefined>(() => edit.value.present.scene);
  const layer = computed<Layer | undefined>(() => scene.value?.layers[0]);
  const dataset = computed<DatasetInfo | undefined>(() =>
    datasets.value.find((d) => d.id === layer.value?.dataset),
  );
  const field = computed<FieldInfo | undefined>(() => {
    const fields = dataset.value?.fields ?? [];
    return fields.find((f) => f.name === layer.value?.field) ?? fields[0];
  });
  const secondField = computed<FieldInfo | undefined>(() =>
    dataset.value?.fields.find((f) => f.name === layer.value?.densityField),
  );
  const bounds = computed<Bounds | undefined>(() => {
    const d = dataset.value;
    if (!d?.boundsMin || !d.boundsMax) return undefined;
    return { min: point(d.boundsMin), max: point(d.boundsMax) };
  });
  const referenceLength = computed(() => {
    const b = bounds.value;
    return referenceLengthOf(b ? length(subtract(b.max, b.min)) : 0);
  });
  return {
    ...shared,
    /** The dataset that was asked for and is not shown yet. */
    pendingDataset: signal<string | undefined>(undefined),
    view: signal<{ readonly state: ViewState; readonly message: string } | undefined>(undefined),
    scene,
    layer,
    dataset,
    field,
    secondField,
    bounds,
    referenceLength,
    orbit: signal<Orbit | undefined>(undefined),
    home: signal<Orbit | undefined>(undefined),
    /** The camera of the picture on the screen. */
    shownOrbit: signal<Orbit | undefined>(undefined),
    /** A turn that is being recorded. */
    recording: signal<Recording | undefined>(undefined),
    /** Of the newest pictures, while performance is shown. */
    samples: signal<readonly Sample[]>([]),
    edit,
    /** One's place in the view, once it is open. */
    seat: signal<Seat | undefined>(undefined),
    /** Who is in the view; empty before the server said. */
    people: signal<readonly Person[]>([]),
    /** Links to the view that were made here, the newest of each role. */
    links: signal<readonly ShareLink[]>([]),
    /** What the server's history of the view allows; undefined: the page's own counts. */
    serverSteps: signal<Steps | undefined>(undefined),
    refusal: signal<Refusal | undefined>(undefined),
    /** The settings that the server took last: what a refusal leaves on the screen. */
    accepted: signal<Edit | undefined>(undefined),
    /** Code in the editor that is not drawn; undefined: it shows the layer's. */
    codeDraft: signal<string | undefined>(undefined),
    /** Code that is to be drawn when the server has described it. */
    appliedCode: signal<string | undefined>(undefined),
    /** The newest descriptions: of code that is drawn, and of code that was tried. */
    describedCodes: signal<readonly DescribedCode[]>([]),
    viewport: signal<ViewportSize | undefined>(undefined),
    picture: signal<PictureInfo | undefined>(undefined),
    /** What the picture shows under the resting pointer. */
    picked: signal<Picked | undefined>(undefined),
    /** A place of the picture whose values stay in sight. */
    pinned: signal<HoverPlace | undefined>(undefined),
    /** How the newest picture was drawn, where that was asked. */
    plan: signal<Plan | undefined>(undefined),
    /** What ways to draw a view are worth, where that was measured. */
    measured: signal<Measured | undefined>(undefined),
    /** What pacing must not change of the pictures sent here. */
    pins: signal<Pins>({}),
    /** The chart of what was measured, or its place, is on the screen. */
    chartInSight: signal(false),
    /** The same as plans with bounds know it, where that was asked. */
    estimated: signal<Measured | undefined>(undefined),
    /** What effects of the picture take, where that was measured. */
    effectTimes: signal<Measured | undefined>(undefined),
    /** The picture's difference from the reference is shown over it. */
    comparing: signal(false),
    difference: signal<Difference | undefined>(undefined),
    /** What the end of the difference's scale stands for, in 1/255. */
    differenceRange: signal(4),
    /** What ray models make of the data as it is shown. */
    thumbnails: signal<ReadonlyMap<RayModel, ModelThumbnail>>(new Map()),
    /** The models whose thumbnails are in sight. */
    pictured: signal<readonly RayModel[]>([]),
    playing: signal<Playing>(kUsualPlaying),
    newestInput: signal(0n),
    framesPerSecond: signal(0),
    latency: signal<{ readonly p50: number; readonly p95: number } | undefined>(undefined),
    /** The camera that shows everything in this viewport, as long as nobody moved it. */
    resting: { orbit: undefined as Orbit | undefined },
    /** When the input that is being handled happened; a plain value, read once. */
    input: { at: undefined as number | undefined },
  };
}

export type AppState = ReturnType<typeof createAppState>;

const kMostNotices = 4;
let lastNotice = 0;

/** Shows a sentence; the same sentence is not shown twice. */
export function notify(state: Pick<AppState, "notices">, kind: Notice["kind"], text: string): void {
  const others = state.notices.value.filter((n) => n.text !== text);
  lastNotice += 1;
  state.notices.value = [...others, { id: lastNotice, kind, text }].slice(-kMostNotices);
}

export function dismiss(state: Pick<AppState, "notices">, id: number): void {
  state.notices.value = state.notices.value.filter((n) => n.id !== id);
}
