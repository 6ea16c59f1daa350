import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { Scale_Kind, ScaleSchema } from "../net/gen/volcast/v1/scene_pb";
import { axisOf, kStraight } from "../transfer/scale";
import { barHeights, opacityOfDrag, rangeOf, valueAt, xOf, yOf } from "./map_plot";

const box = { width: 300, low: -2, high: 6, axis: kStraight };
const white = { r: 1, g: 1, b: 1 };

describe("map plot", () => {
  it("goes from values to pixels and back", () => {
    for (const value of [-2, 0.123, 6]) expect(valueAt(box, xOf(box, value))).toBeCloseTo(value, 9);
    expect(valueAt(box, -50)).toBe(-2);
    expect(valueAt(box, 999)).toBe(6);
  });

  it("lays values out by the field's scale, and not below what it can show", () => {
    const scale = create(ScaleSchema, { kind: Scale_Kind.LOG, domain: { min: 0.01, max: 100 } });
    const axis = axisOf(scale, -1, 100);
    const { low, high } = rangeOf([], -1, 100, axis);
    expect([low, high]).toEqual([0.01, 100]);
    const logs = { width: 220, low, high, axis };
    expect(xOf(logs, 1)).toBeCloseTo(110, 9); // Halfway in powers of ten.
    expect(valueAt(logs, xOf(logs, 0.3))).toBeCloseTo(0.3, 9);
    expect(valueAt(logs, 500)).toBe(100);
  });

  it("moves a point with the hand", () => {
    expect(yOf(0.25 + opacityOfDrag(12))).toBeCloseTo(yOf(0.25) + 12, 9);
  });

  it("shows the field's range and the whole map", () => {
    const map = [
      { value: 1, colour: white, extinction: 0 },
      { value: 9, colour: white, extinction: 0 },
    ];
    expect(rangeOf(map, 0, 5)).toEqual({ low: 0, high: 9 });
    expect(rangeOf([], 3, 3)).toEqual({ low: 2.5, high: 3.5 });
  });

  it("shows counts by their logarithm", () => {
    const heights = barHeights([0, 9, 99, 999]);
    expect(heights[0]).toBe(0);
    expect(heights[2]).toBeCloseTo(2 / 3, 9);
    expect(heights[3]).toBe(1);
    expect(barHeights([0, 0])).toEqual([0, 0]);
  });
});
