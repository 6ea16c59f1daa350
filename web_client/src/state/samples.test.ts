import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { FrameHeaderSchema } from "../net/gen/volcast/v1/frame_pb";
import { createAppState } from "./app_state";
import { keepSample, sampleOf } from "./samples";
import { kUsualOptions } from "./view_options";

const timings = { waitMs: 3, uploadMs: 1, drawMs: 10, readbackMs: 2, encodeMs: 4, queueMs: 1 };
const drawn = { bytes: 1000, at: 5, latency: 40, holdMs: 6, decodeMs: 5 };

describe("samples", () => {
  it("leave to the network what nothing else took", () => {
    const header = create(FrameHeaderSchema, { timings, redrawn: true });
    const sample = sampleOf({ header, ...drawn });
    expect(sample).toMatchObject({ render: 13, encode: 4, decode: 5, network: 40 - 21 - 6 });
    expect(sample.quality).toBeUndefined();
    expect(sampleOf({ header, ...drawn, latency: 2 }).network).toBe(0);
    expect(sampleOf({ header, ...drawn, latency: undefined }).network).toBeUndefined();
  });

  it("say what the server paced", () => {
    const pace = { quality: 70, window: 2, underWay: 1 };
    const sample = sampleOf({ header: create(FrameHeaderSchema, { timings, pace }), ...drawn });
    expect(sample).toMatchObject({ render: 0, quality: 70, credits: [1, 2] });
    const lossless = create(FrameHeaderSchema, { lossless: true, pace });
    expect(sampleOf({ header: lossless, ...drawn }).quality).toBe(100);
  });

  it("are kept while somebody looks", () => {
    const state = createAppState();
    const sample = sampleOf({ header: create(FrameHeaderSchema), ...drawn });
    keepSample(state, sample);
    expect(state.samples.value).toEqual([]);
    state.options.value = { ...kUsualOptions, hud: true };
    for (let i = 0; i < 700; i += 1) keepSample(state, { ...sample, at: i });
    expect(state.samples.value).toHaveLength(600);
    expect(state.samples.value[599]?.at).toBe(699);
  });
});
