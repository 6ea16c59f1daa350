import { create, fromBinary, toBinary } from "@bufbuild/protobuf";
import { notify, type SharedState } from "../state/app_state";
import { sentenceOf } from "../state/refusal";
import { Connection } from "./connection";
import { decodeFrame, type Frame, isFrame, kMajor, kMinor } from "./framing";
import type { Error as ErrorMessage } from "./gen/volcast/v1/error_pb";
import type { Codec } from "./gen/volcast/v1/frame_pb";
import {
  ClientMessageSchema,
  type DatasetInfo,
  DatasetState,
  type ServerMessage,
  ServerMessageSchema,
  type ViewOpened,
  type Welcome,
} from "./gen/volcast/v1/session_pb";
import type { ViewConversation } from "./view_conversation";
import type { Body, Wire } from "./wire";

/** What a page before this one leaves to the next, to go on with its views. */
export interface Resumption {
  readonly token: string;
  /** The largest number of its views. */
  readonly lastNumber: number;
}

export interface SessionDesc {
  readonly url: string;
  readonly state: SharedState;
  /** What can be shown. */
  readonly codecs: readonly Codec[];
  /** The name that others see. */
  readonly person: () => string;
  /** An access token; empty: none. */
  readonly access: string;
  readonly resume: Resumption | undefined;
  /** A colour patch: `patchDecoded` is to be called with what the decoder makes of it. */
  readonly patch: (frame: Frame) => void;
}

const kClient = "volcast web 0.1.0";
const kPingMs = 4000;

/** The connection to the server and all that is not about one view; a lost one is made anew. */
export class Session implements Wire {
  readonly #desc: SessionDesc;
  readonly #connection: Connection;
  readonly #views = new Set<ViewConversation>();
  #lastNumber: number;
  #resume: string;
  greeted = false;

  constructor(desc: SessionDesc) {
    this.#desc = desc;
    this.#lastNumber = desc.resume?.lastNumber ?? 0;
    this.#resume = desc.resume?.token ?? "";
    this.#connection = new Connection(desc.url, {
      opened: () => this.#greet(),
      received: (message) => this.#received(message),
      lost: (retryAt, reason) => this.#lost(retryAt, reason),
      retrying: () => {
        desc.state.connection.value = { kind: "connecting" };
      },
    });
    setInterval(() => this.#ping(), kPingMs);
  }

  connect(): void {
    this.#connection.connect();
  }

  /** What the next page needs to go on with these views; undefined before the server's welcome. */
  get resumption(): Resumption | undefined {
    return this.#resume ? { token: this.#resume, lastNumber: this.#lastNumber } : undefined;
  }

  add(view: ViewConversation): void {
    this.#views.add(view);
    if (this.greeted) view.welcomed(false);
  }

  remove(view: ViewConversation): void {
    this.#views.delete(view);
    view.close();
  }

  newNumber(): number {
    this.#lastNumber += 1;
    return this.#lastNumber;
  }

  send(body: Body): boolean {
    const message = create(ClientMessageSchema, { body });
    const bytes = toBinary(ClientMessageSchema, message);
    return this.#connection.send(bytes as Uint8Array<ArrayBuffer>);
  }

  /** Asks again for a dataset whose import failed. */
  importAgain(dataset: string): void {
    this.send({ case: "openDataset", value: { dataset } });
  }

  /** Asks for a small picture of a dataset that is ready; it comes with the dataset's info. */
  drawDatasetThumbnail(dataset: string): void {
    this.send({ case: "drawDatasetThumbnail", value: { dataset } });
  }

  /** The name that others see from now on. */
  rename(person: string): void {
    this.send({ case: "setName", value: { person } });
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
    this.send({ case: "ack", value: { view, sequence, holdUs, decodeUs, queue, keyframe } });
  }

  /** What the decoder made of a colour patch; `error` says why it made nothing. */
  patchDecoded(codec: Codec, rgb: Uint8Array<ArrayBuffer>, error: string): void {
    this.send({ case: "patchDecoded", value: { codec, rgb, error } });
  }

  #ping(): void {
    this.send({ case: "ping", value: { token: BigInt(Math.round(performance.now())) } });
    this.#connection.checkSilence();
  }

  #greet(): void {
    const { codecs, person, access } = this.#desc;
    this.send({
      case: "hello",
      value: {
        major: kMajor,
        minor: kMinor,
        client: kClient,
        codecs: [...codecs],
        person: person(),
        resume: this.#resume,
        access,
      },
    });
  }

  #lost(retryAt: number, reason: string): void {
    this.greeted = false;
    for (const view of this.#views) view.lost();
    this.#desc.state.connection.value = { kind: "lost", retryAt, reason };
  }

  #welcomed(welcome: Welcome): void {
    this.#desc.state.welcome.value = welcome;
    this.#desc.state.connection.value = { kind: "open" };
    this.#connection.settled();
    this.#resume = welcome.resume;
    this.greeted = true;
    for (const view of this.#views) view.welcomed(welcome.resumed);
  }

  #received(message: Uint8Array<ArrayBuffer>): void {
    const receivedAt = performance.timeOrigin + performance.now();
    try {
      if (isFrame(message)) this.#frame(decodeFrame(message), receivedAt);
      else this.#handle(fromBinary(ServerMessageSchema, message));
    } catch (error) {
      const text = `A message of the server could not be read: ${String(error)}`;
      notify(this.#desc.state, "error", text);
    }
  }

  #viewOf(view: number): ViewConversation | undefined {
    for (const conversation of this.#views) if (conversation.owns(view)) return conversation;
    return undefined;
  }

  #frame(frame: Frame, receivedAt: number): void {
    const { view, sequence } = frame.prefix;
    const owner = this.#viewOf(view);
    if (frame.header.patch) this.#desc.patch(frame);
    else if (owner) owner.frame(frame, receivedAt);
    else this.acknowledge(view, sequence, 0, 0, 0);
  }

  #handle({ body }: ServerMessage): void {
    const { state } = this.#desc;
    switch (body.case) {
      case "welcome":
        this.#welcomed(body.value);
        break;
      case "datasetList":
        state.datasets.value = body.value.datasets;
        break;
      case "datasetInfo":
        this.#dataset(body.value);
        break;
      case "viewOpened":
        this.#opened(body.value);
        break;
      case "viewStatus":
        this.#viewOf(body.value.view)?.status(body.value);
        break;
      case "sceneChanged":
        this.#viewOf(body.value.view)?.changed(body.value);
        break;
      case "people":
        this.#viewOf(body.value.view)?.listed(body.value);
        break;
      case "viewShared":
        this.#viewOf(body.value.view)?.people.shared(body.value);
        break;
      case "picked":
        this.#viewOf(body.value.view)?.questions.picked(body.value);
        break;
      case "plan":
        this.#viewOf(body.value.view)?.questions.planned(body.value);
        break;
      case "accuracyReport":
        this.#viewOf(body.value.view)?.questions.measured(body.value);
        break;
      case "differenceReport":
        this.#viewOf(body.value.view)?.questions.compared(body.value);
        break;
      case "thumbnail":
        this.#viewOf(body.value.view)?.questions.thumbnail(body.value);
        break;
      case "shaderDescription":
        for (const view of this.#views) view.questions.described(body.value);
        break;
      case "error":
        this.#error(body.value);
        break;
    }
  }

  #dataset(info: DatasetInfo): void {
    const { datasets } = this.#desc.state;
    const known = datasets.value.some((d) => d.id === info.id);
    datasets.value = known
      ? datasets.value.map((d) => (d.id === info.id ? info : d))
      : [...datasets.value, info];
  }

  /** A view that the server kept and nobody here wants any more is closed. */
  #opened(message: ViewOpened): void {
    const owner = this.#viewOf(message.view);
    if (owner) owner.opened(message);
    else this.send({ case: "closeView", value: { view: message.view } });
  }

  #error(error: ErrorMessage): void {
    if (error.view !== 0) {
      this.#viewOf(error.view)?.error(error); // Else of a view that was just closed.
      return;
    }
    // Its time was over: the views are opened again as they were.
    if (error.field === "hello.resume") return;
    const info = this.#desc.state.datasets.value.find((d) => d.id === error.dataset);
    if (info?.state === DatasetState.FAILED) return; // The list shows it itself.
    notify(this.#desc.state, "error", sentenceOf(error));
  }
}
