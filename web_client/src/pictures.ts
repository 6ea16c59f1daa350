import type { Frame } from "./net/framing";
import { Codec } from "./net/gen/volcast/v1/frame_pb";
import type { Session } from "./net/session";
import { type AppState, notify } from "./state/app_state";
import { Recorder } from "./state/recorder";
import { keepSample, sampleOf } from "./state/samples";
import { openScreen, type Screen } from "./video/screen";
import type { EncodedPicture, PictureReport } from "./video/worker_messages";
import { keepHeight, type PictureElement } from "./view/picture_element";

export interface PicturesDesc {
  readonly state: AppState;
  readonly session: Session;
  readonly picture: PictureElement;
  /** When the input that a frame is the first to show happened. */
  readonly takeInputTime: (inputSeq: bigint) => number | undefined;
}

let lastId = 0;

function encodedPicture({ prefix, header, payload }: Frame, receivedAt: number): EncodedPicture {
  lastId += 1;
  const { codec, width, height, keyframe, lossless, pixelsXxh32 } = header;
  const about = { codec, width, height, keyframe, lossless, pixelsXxh32 };
  return { id: lastId, view: prefix.view, ...about, payload, receivedAt };
}

/** Frames of one view on their way to its canvas: decoded, drawn, measured and acknowledged. */
export class Pictures {
  readonly screen: Screen;
  readonly recorder: Recorder;
  readonly #desc: PicturesDesc;
  /** Frames that the screen works on, by the ids of their pictures. */
  readonly #underway = new Map<number, { frame: Frame; bytes: number }>();

  constructor(desc: PicturesDesc) {
    const { state, session, picture } = desc;
    this.#desc = desc;
    this.recorder = new Recorder(state);
    this.screen = openScreen(
      picture.canvas,
      (report) => this.#reported(report),
      ({ codec, rgb, error }) => session.patchDecoded(codec, rgb, error),
      (reason) => notify(state, "error", `Pictures cannot be shown: ${reason}`),
    );
  }

  show(frame: Frame, receivedAt: number): void {
    const picture = encodedPicture(frame, receivedAt);
    this.#underway.set(picture.id, { frame, bytes: frame.payload.length });
    this.screen.show(picture);
  }

  tryPatch(frame: Frame): void {
    this.screen.tryPatch(encodedPicture(frame, 0));
  }

  /** Pictures on their way are of a connection that is gone: nobody waits to hear of them. */
  restart(): void {
    this.#underway.clear();
  }

  close(): void {
    this.recorder.close();
    this.screen.close();
  }

  #reported(report: PictureReport): void {
    const item = this.#underway.get(report.id);
    this.#underway.delete(report.id);
    if (!item) return;
    const { state, session, takeInputTime } = this.#desc;
    const { header, prefix } = item.frame;
    const holdMs = report.doneAt - report.receivedAt;
    const { decodeMs, queue, keyframeNeeded } = report;
    session.acknowledge(prefix.view, prefix.sequence, holdMs, decodeMs, queue, keyframeNeeded);
    if (report.kind === "failed" && !keyframeNeeded) {
      notify(state, "error", `Picture ${prefix.sequence} could not be decoded: ${report.reason}`);
    }
    if (report.kind !== "drawn") return;
    const at = report.doneAt - performance.timeOrigin;
    const inputAt = takeInputTime(header.inputSeq);
    const latency = inputAt === undefined ? undefined : at - inputAt;
    this.recorder.drawn(at, inputAt);
    keepSample(state, sampleOf({ header, bytes: item.bytes, at, latency, holdMs, decodeMs }));
    if (header.redrawn && header.timings) {
      const { waitMs, uploadMs, drawMs, readbackMs, encodeMs, queueMs } = header.timings;
      this.recorder.took({
        wait: waitMs,
        upload: uploadMs,
        draw: drawMs,
        readback: readbackMs,
        encode: encodeMs,
        queue: queueMs,
        decode: decodeMs,
      });
    }
    this.#shown(item.frame, item.bytes, report);
  }

  #shown({ prefix, header }: Frame, bytes: number, { decodeMs, exact }: PictureReport): void {
    const { state, picture } = this.#desc;
    const { timings } = header;
    state.picture.value = { ...header, view: prefix.view, timings, bytes, decodeMs, exact };
    const { dataset } = picture.element;
    dataset.view = String(prefix.view);
    dataset.sequence = String(prefix.sequence);
    dataset.inputSeq = String(header.inputSeq);
    dataset.lossless = String(header.lossless);
    dataset.exact = String(exact ?? "");
    dataset.codec = Codec[header.codec] ?? "";
    dataset.workerGeneration = String(header.workerGeneration);
    dataset.size = `${header.width}x${header.height}`;
    keepHeight(picture, header.width / Math.max(1, header.height));
  }
}
