import { toBinary } from "@bufbuild/protobuf";
import { effect, untracked } from "@preact/signals";
import { type RayModel, type Scene, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import type { Thumbnail } from "../net/gen/volcast/v1/session_pb";
import { withLayer } from "./actions";
import type { AppState } from "./app_state";
import { partsFor } from "./layer_actions";
import { sceneMessage } from "./scene_message";

/** In CSS pixels. */
export const kThumbnailWidth = 96;
export const kThumbnailHeight = 72;
const kMostSide = 256;

/** What a ray model makes of the data as it is shown. */
export interface ModelThumbnail {
  /** Undefined where it could not be drawn. */
  readonly picture: Blob | undefined;
  readonly refusal: string;
}

/** The scene that choosing `model` would show; layers run no code. */
export function sceneOfModel(state: AppState, model: RayModel): Scene | undefined {
  const { scene, layer, orbit, bounds, edit, field } = state;
  if (!scene.value || !layer.value || !orbit.value) return undefined;
  const chosen = withLayer(scene.value, partsFor(layer.value, model, field.value));
  const layers = chosen.layers.map((l) => ({ ...l, shader: undefined }));
  return sceneMessage({ ...chosen, layers }, orbit.value, bounds.value, edit.value.present);
}

/** Device pixels of a thumbnail, as many as the server draws at most. */
export function thumbnailSize(pixelRatio: number): { width: number; height: number } {
  const ratio = Math.min(Math.max(1, pixelRatio), kMostSide / kThumbnailWidth);
  return {
    width: Math.round(kThumbnailWidth * ratio),
    height: Math.round(kThumbnailHeight * ratio),
  };
}

interface Wanted {
  readonly request: number;
  readonly model: RayModel;
  readonly key: string;
}

/**
 * Keeps the thumbnails of the models in sight up to date, one after the other, while the picture is
 * at rest. `ask` sends a request; false: it cannot now. `answered` takes what came of the newest.
 */
export class ThumbnailKeeper {
  readonly #state: AppState;
  readonly #ask: (request: number, scene: Scene) => boolean;
  /** The scene of each thumbnail that is there. */
  readonly #drawn = new Map<RayModel, string>();
  #waiting: Wanted | undefined;
  #requests = 0;

  constructor(state: AppState, ask: (request: number, scene: Scene) => boolean) {
    this.#state = state;
    this.#ask = ask;
  }

  /** Asks for the next one, if the picture is at rest and one is missing or of another scene. */
  advance(): void {
    if (this.#waiting) return;
    for (const model of this.#state.pictured.value) {
      const scene = sceneOfModel(this.#state, model);
      if (!scene) return;
      const key = toBinary(SceneSchema, scene).join();
      if (this.#drawn.get(model) === key) continue;
      this.#requests += 1;
      const wanted = { request: this.#requests, model, key };
      if (this.#ask(wanted.request, scene)) this.#waiting = wanted;
      return;
    }
  }

  /** True where `advance` may go on. */
  answered({
    request,
    picture,
    refusal,
  }: Pick<Thumbnail, "request" | "picture" | "refusal">): boolean {
    const wanted = this.#waiting;
    if (!wanted || (request !== wanted.request && !refusal)) return false;
    this.#waiting = undefined;
    this.#drawn.set(wanted.model, wanted.key);
    const blob = refusal ? undefined : new Blob([picture as Uint8Array<ArrayBuffer>]);
    const next = new Map(this.#state.thumbnails.value);
    next.set(wanted.model, { picture: blob, refusal });
    this.#state.thumbnails.value = next;
    return true;
  }

  /** What was asked for is not answered any more. */
  lost(): void {
    this.#waiting = undefined;
  }
}

/** The exact picture of the newest input is on the screen. */
export function atRest(state: AppState): boolean {
  const picture = state.picture.value;
  const isOpen = state.connection.value.kind === "open";
  return isOpen && !!picture?.final && picture.inputSeq >= state.newestInput.value;
}

const kRestMs = 250;

/** Lets `keeper` work whenever the picture has been at rest for a moment; returns its end. */
export function followThumbnails(state: AppState, keeper: ThumbnailKeeper): () => void {
  let timer = 0;
  return effect(() => {
    const wanted = state.pictured.value.length > 0 && atRest(state);
    state.dataset.value;
    if (state.connection.value.kind !== "open") keeper.lost();
    clearTimeout(timer);
    if (wanted) timer = window.setTimeout(() => untracked(() => keeper.advance()), kRestMs);
  });
}
