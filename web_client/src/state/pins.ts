import { effect, untracked } from "@preact/signals";
import { Codec, type Pace } from "../net/gen/volcast/v1/frame_pb";
import type { AppState, PictureInfo } from "./app_state";

/** What a person forbids pacing to change of the pictures sent to them; undefined: as the connection allows. */
export interface Pins {
  /** Of JPEG and video, 30 to 100. */
  readonly quality?: number | undefined;
  /** Of the picture's sides, 0.25 to 1. */
  readonly scale?: number | undefined;
  /** True: moving pictures as accurate as asked for; false: drawn as fast as can be. */
  readonly fullAccuracy?: boolean | undefined;
  /** At most so many, 1 to 240. */
  readonly framesPerS?: number | undefined;
}

export const hasPins = (pins: Pins): boolean =>
  Object.values(pins).some((value) => value !== undefined);

/** Sends pins when they change, and again to a view that is opened or come back to; returns the end. */
export function followPins(state: AppState, send: (pins: Pins) => void): () => void {
  let sent = false;
  return effect(() => {
    const pins = state.pins.value;
    const isOpen = state.connection.value.kind === "open" && state.seat.value !== undefined;
    state.welcome.value; // Another connection knows no pins.
    if (!isOpen || (!sent && !hasPins(pins))) return;
    sent = true;
    untracked(() => send(pins));
  });
}

const kCodecNames: Readonly<Partial<Record<Codec, string>>> = {
  [Codec.JPEG]: "JPEG",
  [Codec.PNG]: "PNG",
  [Codec.WEBP]: "WebP",
  [Codec.VP9]: "VP9",
  [Codec.H264]: "H.264",
};

/** "JPEG, quality 75, sides × 0.75, accuracy as asked, at most 15 pictures/s". */
export function paceSentence({ codec, lossless }: PictureInfo, pace: Pace): string {
  const rate = pace.framesPerS > 0 ? `at most ${pace.framesPerS} pictures/s` : "as many as drawn";
  return [
    lossless ? "lossless" : (kCodecNames[codec] ?? `codec ${codec}`),
    lossless ? "" : `quality ${pace.quality}`,
    pace.scale < 1 ? `sides × ${pace.scale}` : "full size",
    pace.fullAccuracy ? "accuracy as asked" : "drawn faster, less accurate",
    rate,
  ]
    .filter(Boolean)
    .join(", ");
}
