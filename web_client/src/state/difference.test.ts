import { create } from "@bufbuild/protobuf";
import { beforeEach, describe, expect, it } from "vitest";
import { SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { type DifferenceReport, DifferenceReportSchema } from "../net/gen/volcast/v1/session_pb";
import { dragged } from "../view/camera";
import { isOfThisPicture, measuringBegan } from "./accuracy";
import { adoptScene, changeLayer } from "./actions";
import { type AppState, createAppState } from "./app_state";
import {
  comparingBegan,
  comparisonEnded,
  comparisonReported,
  fillPart,
  kReplaced,
  needsComparison,
} from "./difference";

/** Whole numbers below 2048 and their halves in binary16. */
const halves = (values: readonly number[]): Uint8Array => {
  const bits = values.map((v) => {
    const exponent = v === 0 ? -15 : Math.floor(Math.log2(v));
    return v === 0 ? 0 : ((exponent + 15) << 10) | ((v / 2 ** exponent - 1) * 1024);
  });
  return Uint8Array.from(bits.flatMap((b) => [b & 255, b >> 8]));
};

const report = (part: Partial<DifferenceReport>): DifferenceReport =>
  Object.assign(
    create(DifferenceReportSchema, { width: 4, height: 3, step: 1, pixels: 12n }),
    part,
  );

describe("parts of a difference picture", () => {
  it("fill the squares that they stand for, and finer ones replace them", () => {
    const off = new Float32Array(12).fill(Number.NaN);
    fillPart(off, report({ step: 2, off: halves([1, 2, 3, 4]) }));
    expect([...off]).toEqual([1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 4, 4]);
    const finer = [5, 6, 7, 8, 9, 10, 11, 12];
    fillPart(off, report({ refines: true, off: halves(finer) }));
    expect([...off]).toEqual([1, 5, 2, 6, 7, 8, 9, 10, 3, 11, 4, 12]);
  });

  it("may begin at a later row", () => {
    const off = new Float32Array(12).fill(Number.NaN);
    fillPart(off, report({ firstRow: 2, off: halves([1, 2, 3, 4]) }));
    expect([...off.slice(8)]).toEqual([1, 2, 3, 4]);
    expect(off[7]).toBeNaN();
  });
});

const scene = create(SceneSchema, {
  camera: { eye: { y: -9 }, center: {}, up: { z: 1 }, fovyDegrees: 30 },
  layers: [{ id: "first", dataset: "d" }],
});

const kFinal = {
  view: 1,
  inputSeq: 1n,
  width: 4,
  height: 3,
  codec: 2,
  lossless: true,
  final: true,
  ready: true,
  integrators: [],
  workerGeneration: 1,
  timings: undefined,
  bytes: 1,
  decodeMs: 1,
} as const;

let state: AppState;
beforeEach(() => {
  state = createAppState();
  adoptScene(state, scene);
  state.connection.value = { kind: "open" };
  state.newestInput.value = 1n;
  state.picture.value = kFinal;
  state.comparing.value = true;
});

describe("a comparison", () => {
  it("is needed for an exact picture of the newest input, once", () => {
    expect(needsComparison(state)).toBe(true);
    comparingBegan(state);
    expect(needsComparison(state)).toBe(false);
    comparisonReported(state, report({ done: true, off: halves(new Array(12).fill(1)) }));
    expect(needsComparison(state)).toBe(false);
    expect(state.difference.value).toMatchObject({ running: false, step: 1, width: 4 });
    state.picture.value = { ...kFinal, final: false };
    changeLayer(state, { integrator: 1 });
    expect(needsComparison(state)).toBe(false);
    state.picture.value = kFinal;
    expect(needsComparison(state)).toBe(true);
    state.newestInput.value = 2n;
    expect(needsComparison(state)).toBe(false);
  });

  it("waits for a measurement and goes on when it was replaced by one", () => {
    comparingBegan(state);
    measuringBegan(state);
    comparisonReported(state, report({ done: true, stopped: kReplaced }));
    expect(needsComparison(state)).toBe(false);
    state.measured.value = undefined;
    expect(needsComparison(state)).toBe(true);
    comparingBegan(state);
    comparisonReported(state, report({ done: true, stopped: "stopped by the client" }));
    expect(needsComparison(state)).toBe(false);
  });

  it("belongs to the picture until anything changes, the way to draw included", () => {
    comparingBegan(state);
    const { value } = state.difference;
    if (!value) throw new Error("nothing began");
    expect(isOfThisPicture(state, value)).toBe(true);
    if (state.orbit.value) state.orbit.value = dragged(state.orbit.value, 9, 0, 0.01);
    expect(isOfThisPicture(state, value)).toBe(false);
  });

  it("ends with the connection and keeps what it found", () => {
    comparingBegan(state);
    comparisonReported(state, report({ off: halves([1, 2]), maxError: 0.5 }));
    comparisonEnded(state, "the connection was lost");
    expect(state.difference.value).toMatchObject({
      running: false,
      stopped: "the connection was lost",
      figures: { max: 0.5, pixels: 12 },
    });
    expect(state.difference.value?.off[0]).toBe(1);
  });
});
