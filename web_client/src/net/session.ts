import { create, fromBinary, type MessageInitShape, toBinary } from "@bufbuild/protobuf";
import { measuringBegan, measuringEnded, measuringReported } from "../state/accuracy";
import { type AppState, type Edit, notify } from "../state/app_state";
import type { ViewDocument } from "../state/document";
import { sentenceOf } from "../state/refusal";
import { cameraMessage, sceneMessage } from "../state/scene_message";
import { type CodeOfData, removeCode, takeDescription } from "../state/shader_actions";
import { Connection } from "./connection";
import { decodeFrame, type Frame, isFrame, kMajor, kMinor } from "./framing";
import type { Error as ErrorMessage } from "./gen/volcast/v1/error_pb";
import type { Codec } from "./gen/volcast/v1/frame_pb";
import type { Scene } from "./gen/volcast/v1/scene_pb";
import {
  ClientMessageSchema,
  DatasetState,
  type Picked,
  type PinsSchema,
  type ServerMessage,
  ServerMessageSchema,
  ViewState,
  type ViewStatus,
} from "./gen/volcast/v1/session_pb";
import { type Dirty, InputPacer } from "./input_pacer";

type Body = NonNullable<MessageInitShape<typeof ClientMessageSchema>["body"]>;

/** What a session asks of whoever joins the parts. */
export interface SessionEvents {
  /** A frame of the view that is shown, or of the one that is about to be. */
  frame(frame: Frame, receivedAt: number): void;
  /** A colour patch: `patchDecoded` is to be called with what the decoder makes of it. */
  patch(frame: Frame): void;
  /** The server opened a view with its own default scene. */
  opened(scene: Scene): void;
  /** A view was opened with a document that was not shown before. */
  restored(document: ViewDocument): void;
  /** What is shown now with all its edits, to open it again after a loss. */
  current(): ViewDocument | undefined;
}

/** What to show; an empty `dataset` is the server's first. */
interface Wish {
  readonly dataset: string;
  readonly document: ViewDocument | undefined;
  /** The document is what is shown already; edits made since it was sent are newer. */
  readonly shown: boolean;
}

interface Opening extends Wish {
  readonly view: number;
}

const kAnything: Wish = { dataset: "", document: undefined, shown: false };

function wishToStay(document: ViewDocument | undefined): Wish | undefined {
  const dataset = document?.scene.layers[0]?.dataset ?? "";
  return document && { dataset, document, shown: true };
}

const kClient = "volcast web 0.1.0";
const kPingMs = 4000;

/** The conversation with the server: one view at a time, opened anew after every loss. */
export class Session {
  readonly #codecs: readonly Codec[];
  readonly #state: AppState;
  readonly #events: SessionEvents;
  readonly #connection: Connection;
  readonly #pacer: InputPacer;
  #view: number | undefined;
  #opening: Opening | undefined;
  #lastView = 0;
  #greeted = false;
  /** Asked for and not opened yet. */
  #wish: Wish | undefined;
  /** The pixel whose answer is waited for or shown. */
  #picking: { readonly inputSeq: bigint; readonly x: number; readonly y: number } | undefined;
  /** The code whose description is waited for. */
  #describing: { readonly request: number; readonly asked: CodeOfData } | undefined;
  /** The newest settings that were sent, and the Update they went with. */
  #sentEdit: { readonly inputSeq: bigint; readonly edit: Edit } | undefined;

  /** `codecs`: what can be shown. */
  constructor(url: string, state: AppState, codecs: readonly Codec[], events: SessionEvents) {
    this.#codecs = codecs;
    this.#state = state;
    this.#events = events;
    this.#connection = new Connection(url, {
      opened: () => this.#greet(),
      received: (message) => this.#received(message),
      lost: (retryAt, reason) => this.#lost(retryAt, reason),
      retrying: () => {
        state.connection.value = { kind: "connecting" };
      },
    });
    this.#pacer = new InputPacer(
      (dirty, inputSeq) => this.#sendUpdate(dirty, inputSeq),
      (run) => requestAnimationFrame(run),
      () => performance.now(),
    );
    setInterval(() => this.#ping(), kPingMs);
  }

  connect(): void {
    this.#connection.connect();
  }

  /** Shows a dataset once it is there; what is shown now stays until then. */
  open(dataset: string, document?: ViewDocument): void {
    this.#wish = { dataset, document, shown: false };
    if (this.#greeted) this.#open();
  }

  /** A part of the state changed; the newest state is sent when the server can use it. */
  mark(part: keyof Dirty): void {
    const { input } = this.#state;
    this.#pacer.mark(part, input.at ?? performance.now());
    input.at = undefined;
  }

  /** The picture's size is known or changed. */
  resized(): void {
    if (this.#greeted && !this.#view && !this.#opening) this.#open();
    else this.mark("viewport");
  }

  /** Asks again for a dataset whose import failed. */
  importAgain(dataset: string): void {
    this.#send({ case: "openDataset", value: { dataset } });
  }

  /** Asks for a small picture of a dataset that is ready; it comes with the dataset's info. */
  drawThumbnail(dataset: string): void {
    this.#send({ case: "drawThumbnail", value: { dataset } });
  }

  /** Sends everything again: the way out of a failed view. */
  drawAgain(): void {
    if (this.#view !== undefined) this.mark("scene");
    else if (this.#greeted && !this.#opening) this.#open();
  }

  /** Asks what a pixel of the picture of `inputSeq` shows; the answer is in `state.picked`. */
  pick(inputSeq: bigint, x: number, y: number): void {
    if (this.#view === undefined) return;
    this.#picking = { inputSeq, x, y };
    this.#send({ case: "pick", value: { view: this.#view, inputSeq, x, y } });
  }

  /** The answer that may still come is of no use. */
  stopPicking(): void {
    this.#picking = undefined;
    this.#state.picked.value = undefined;
  }

  /** Asks how the newest picture was drawn; the answer is in `state.plan`. */
  explain(): void {
    if (this.#view !== undefined) this.#send({ case: "explain", value: { view: this.#view } });
  }

  /** Measures the view's accuracy and cost; reports arrive in `state.measured`. */
  measureAccuracy(): void {
    if (this.#view === undefined) return;
    measuringBegan(this.#state);
    this.#send({ case: "measureAccuracy", value: { view: this.#view } });
  }

  stopMeasuring(): void {
    const { value } = this.#state.measured;
    if (this.#view === undefined || !value?.running) return;
    this.#send({ case: "measureAccuracy", value: { view: this.#view, stop: true } });
  }

  /** Asks what the server reads in code; the newest answer alone counts. */
  describeShader(asked: CodeOfData): void {
    const request = (this.#describing?.request ?? 0) + 1;
    this.#describing = { request, asked };
    this.#send({ case: "describeShader", value: { request, ...asked } });
  }

  /** `keyframe`: this picture of a video could not be decoded. */
  acknowledge(
    view: number,
    sequence: number,
    holdMs: number,
    decodeMs: number,
    queue: number,
    keyframe = false,
  ): void {
    const holdUs = Math.round(holdMs * 1000);
    const decodeUs = Math.round(decodeMs * 1000);
    this.#send({ case: "ack", value: { view, sequence, holdUs, decodeUs, queue, keyframe } });
  }

  /** Replaces what pacing must not change; undefined members are left to it. */
  setPins(pins: MessageInitShape<typeof PinsSchema>): void {
    if (this.#view === undefined) return;
    this.#send({ case: "setPins", value: { view: this.#view, pins } });
  }

  /** What the decoder made of a colour patch; `error` says why it made nothing. */
  patchDecoded(codec: Codec, rgb: Uint8Array<ArrayBuffer>, error: string): void {
    this.#send({ case: "patchDecoded", value: { codec, rgb, error } });
  }

  /** When the input that this frame is the first to show happened. */
  takeInputTime(inputSeq: bigint): number | undefined {
    return this.#pacer.takeInputTime(inputSeq);
  }

  #send(body: Body): boolean {
    const message = create(ClientMessageSchema, { body });
    const bytes = toBinary(ClientMessageSchema, message);
    return this.#connection.send(bytes as Uint8Array<ArrayBuffer>);
  }

  #ping(): void {
    this.#send({ case: "ping", value: { token: BigInt(Math.round(performance.now())) } });
    this.#connection.checkSilence();
  }

  #greet(): void {
    const codecs = [...this.#codecs];
    this.#send({ case: "hello", value: { major: kMajor, minor: kMinor, client: kClient, codecs } });
  }

  #lost(retryAt: number, reason: string): void {
    this.#greeted = false;
    this.#view = undefined;
    this.#opening = undefined;
    this.#state.view.value = undefined;
    measuringEnded(this.#state, "the connection was lost");
    this.#state.connection.value = { kind: "lost", retryAt, reason };
  }

  #open(): void {
    const viewport = this.#state.viewport.value;
    if (!viewport) return;
    if (this.#opening) this.#close(this.#opening.view);
    this.#lastView += 1;
    const view = this.#lastView;
    const wish = this.#wish ?? wishToStay(this.#events.current()) ?? kAnything;
    const { dataset, document } = wish;
    this.#opening = { ...wish, view };
    this.#state.pendingDataset.value = dataset || undefined;
    if (this.#view === undefined) {
      this.#state.view.value = { state: ViewState.WAITING, message: "" };
    }
    const box = dataset === this.#state.dataset.value?.id ? this.#state.bounds.value : undefined;
    const scene = document && sceneMessage(document.scene, document.orbit, box, document.edit);
    const inputSeq = this.#pacer.takeForOpen();
    this.#state.newestInput.value = inputSeq;
    this.#send({ case: "openView", value: { view, dataset, viewport, inputSeq, scene } });
  }

  #close(view: number): void {
    this.#send({ case: "closeView", value: { view } });
  }

  #sendUpdate(dirty: Readonly<Dirty>, inputSeq: bigint): boolean {
    const { scene, orbit, bounds, viewport } = this.#state;
    const edit = this.#state.edit.value.present;
    const view = this.#view;
    if (view === undefined || !scene.value || !orbit.value) return false;
    const sent = this.#send({
      case: "update",
      value: {
        view,
        inputSeq,
        scene: dirty.scene ? sceneMessage(scene.value, orbit.value, bounds.value, edit) : undefined,
        camera: dirty.camera && !dirty.scene ? cameraMessage(orbit.value, bounds.value) : undefined,
        viewport: dirty.viewport ? viewport.value : undefined,
      },
    });
    if (!sent) return false;
    this.#state.newestInput.value = inputSeq;
    if (dirty.scene) this.#sentEdit = { inputSeq, edit };
    return true;
  }

  #received(message: Uint8Array<ArrayBuffer>): void {
    const receivedAt = performance.timeOrigin + performance.now();
    try {
      if (isFrame(message)) this.#frame(decodeFrame(message), receivedAt);
      else this.#handle(fromBinary(ServerMessageSchema, message));
    } catch (error) {
      notify(this.#state, "error", `A message of the server could not be read: ${String(error)}`);
    }
  }

  #frame(frame: Frame, receivedAt: number): void {
    if (frame.header.patch) {
      this.#events.patch(frame);
      return;
    }
    const { view, sequence } = frame.prefix;
    if (view !== this.#view && view !== this.#opening?.view) {
      this.acknowledge(view, sequence, 0, 0, 0);
      return;
    }
    this.#pacer.answered(frame.header.inputSeq);
    this.#accepted(frame.header.inputSeq);
    this.#events.frame(frame, receivedAt);
  }

  /** A picture of `inputSeq` is there: settings up to it were taken, if they were not refused. */
  #accepted(inputSeq: bigint): void {
    const { refusal, accepted } = this.#state;
    const sent = this.#sentEdit;
    if (!sent || inputSeq < sent.inputSeq || sent.inputSeq === refusal.value?.inputSeq) return;
    accepted.value = sent.edit;
    refusal.value = undefined;
  }

  #handle({ body }: ServerMessage): void {
    const state = this.#state;
    switch (body.case) {
      case "welcome":
        state.welcome.value = body.value;
        state.connection.value = { kind: "open" };
        this.#connection.settled();
        this.#greeted = true;
        this.#open();
        break;
      case "datasetList":
        state.datasets.value = body.value.datasets;
        break;
      case "datasetInfo": {
        const info = body.value;
        const known = state.datasets.value.some((d) => d.id === info.id);
        state.datasets.value = known
          ? state.datasets.value.map((d) => (d.id === info.id ? info : d))
          : [...state.datasets.value, info];
        break;
      }
      case "viewOpened":
        if (body.value.scene) this.#opened(body.value.view, body.value.scene);
        break;
      case "viewStatus":
        this.#viewStatus(body.value);
        break;
      case "picked":
        this.#picked(body.value);
        break;
      case "plan":
        if (body.value.view === this.#view) state.plan.value = body.value;
        break;
      case "accuracyReport":
        if (body.value.view === this.#view) measuringReported(state, body.value);
        break;
      case "shaderDescription": {
        const { request, controls, complaints } = body.value;
        const described = this.#describing;
        if (request !== described?.request) break;
        takeDescription(state, { ...described.asked, controls, complaints });
        break;
      }
      case "error":
        this.#error(body.value);
        break;
    }
  }

  #picked(picked: Picked): void {
    const asked = this.#picking;
    if (picked.view !== this.#view || picked.x !== asked?.x || picked.y !== asked?.y) return;
    this.#state.picked.value = picked;
  }

  #opened(view: number, scene: Scene): void {
    const opening = this.#opening;
    if (view !== opening?.view) return;
    const before = this.#view;
    this.#opening = undefined;
    this.#wish = undefined;
    this.#view = view;
    measuringEnded(this.#state, "other data is shown");
    this.#state.pendingDataset.value = undefined;
    this.#state.view.value = { state: ViewState.ACTIVE, message: "" };
    if (before !== undefined) this.#close(before);
    if (!opening.document) this.#events.opened(scene);
    else if (!opening.shown) this.#events.restored(opening.document);
    if (!opening.shown) {
      this.#sentEdit = undefined;
      this.#state.refusal.value = undefined;
      this.#state.accepted.value = this.#state.edit.value.present;
    }
    this.#pacer.answered(0n); // Changes from before the view was open may leave now.
  }

  #viewStatus({ view, state, message }: ViewStatus): void {
    const opening = view === this.#opening?.view;
    if (opening && state === ViewState.FAILED) {
      this.#giveUpOpening(message);
      return;
    }
    if (view !== this.#view && !opening) return;
    if (opening && this.#view !== undefined) return;
    this.#state.view.value = { state, message };
  }

  #error(error: ErrorMessage): void {
    // A pixel of a picture that newer ones have pushed out: the next picture is asked again.
    if (error.field === "input_seq" && error.inputSeq === this.#picking?.inputSeq) return;
    if (this.#refusesMeasuring(error)) {
      measuringEnded(this.#state, sentenceOf({ field: "", message: error.message }));
      return;
    }
    if (error.inputSeq > 0n) this.#pacer.answered(error.inputSeq);
    const text = sentenceOf(error);
    if (this.#opening && error.view === this.#opening.view) this.#giveUpOpening(text);
    else if (this.#refusesSettings(error)) {
      const { inputSeq, field, message } = error;
      this.#state.refusal.value = { inputSeq, field, message };
      this.mark("camera"); // Both may have been parts of the refused update.
      this.mark("viewport");
    } else if (!this.#isListed(error.dataset)) {
      notify(this.#state, "error", text);
      // Code that drew well has failed by itself: the view is back at what was there before it.
      const later = this.#sentEdit !== undefined && error.inputSeq > this.#sentEdit.inputSeq;
      if (later && error.view === this.#view && /\.shader\./.test(error.field)) {
        removeCode(this.#state);
      }
    }
  }

  #refusesMeasuring({ view, field }: ErrorMessage): boolean {
    return field === "view" && view === this.#view && this.#state.measured.value?.running === true;
  }

  /** The newest settings are not drawn; what was drawn before them stays. */
  #refusesSettings({ view, field, inputSeq }: ErrorMessage): boolean {
    return view === this.#view && field !== "" && inputSeq === this.#sentEdit?.inputSeq;
  }

  /** The list shows this dataset's failure itself. */
  #isListed(dataset: string): boolean {
    const info = this.#state.datasets.value.find((d) => d.id === dataset);
    return info?.state === DatasetState.FAILED;
  }

  /** Keeps what is shown; a view that could not be restored is opened from scratch. */
  #giveUpOpening(reason: string): void {
    const opening = this.#opening;
    if (!opening) return;
    this.#close(opening.view);
    this.#opening = undefined;
    this.#state.pendingDataset.value = undefined;
    notify(this.#state, "error", reason);
    this.#wish = undefined;
    if (this.#view !== undefined) {
      this.mark("camera"); // The view that is shown answers the newest input again.
    } else if (opening.document) {
      this.#wish = kAnything;
      this.#open();
    } else {
      this.#state.view.value = { state: ViewState.FAILED, message: reason };
    }
  }
}
