import type { FrameHeader } from "../net/gen/volcast/v1/frame_pb";
import type { AppState } from "./app_state";

/** What one drawn picture took, in ms, and what it was like. */
export interface Sample {
  /** When it was drawn, on performance.now()'s clock. */
  readonly at: number;
  /** Input to drawn; absent where the picture is not the first of an input. */
  readonly latency: number | undefined;
  readonly render: number;
  readonly encode: number;
  /** What of `latency` nobody measured: on the wire both ways. */
  readonly network: number | undefined;
  readonly decode: number;
  readonly bytes: number;
  /** JPEG's; 100 for a lossless picture. */
  readonly quality: number | undefined;
  /** Frames under way, of how many. */
  readonly credits: readonly [underWay: number, window: number] | undefined;
}

interface Drawn {
  readonly header: FrameHeader;
  readonly bytes: number;
  readonly at: number;
  readonly latency: number | undefined;
  readonly holdMs: number;
  readonly decodeMs: number;
}

export function sampleOf({ header, bytes, at, latency, holdMs, decodeMs }: Drawn): Sample {
  const t = header.timings;
  const render = (t?.uploadMs ?? 0) + (t?.drawMs ?? 0) + (t?.readbackMs ?? 0);
  const encode = t?.encodeMs ?? 0;
  const known = (t?.waitMs ?? 0) + render + encode + (t?.queueMs ?? 0) + holdMs;
  const { pace } = header;
  return {
    at,
    latency,
    render: header.redrawn ? render : 0,
    encode,
    network: latency === undefined ? undefined : Math.max(0, latency - known),
    decode: decodeMs,
    bytes,
    quality: header.lossless ? 100 : pace?.quality || undefined,
    credits: pace?.window ? [pace.underWay, pace.window] : undefined,
  };
}

const kMost = 600;

/** Keeps what is shown of the newest pictures, while somebody looks at it. */
export function keepSample(state: AppState, sample: Sample): void {
  if (!state.options.value.hud) return;
  state.samples.value = [...state.samples.value.slice(1 - kMost), sample];
}
