import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { AccuracyRowSchema } from "../net/gen/volcast/v1/session_pb";
import { kFloor, logRange, logTicks, nearest, pointsOf } from "./accuracy_points";

const row = (layer: string, medianMs: number, rmsError: number, refusal = "") =>
  create(AccuracyRowSchema, { layer, medianMs, rmsError, refusal });

describe("points of the accuracy chart", () => {
  it("are a layer's measured rows by time, in 1/255", () => {
    const rows = [row("a", 9, 0), row("a", 4, 2 / 255), row("b", 1, 1), row("a", 1, 1, "no room")];
    const points = pointsOf(rows, "a");
    expect(points.map((p) => p.ms)).toEqual([4, 9]);
    expect(points[0]?.error).toBeCloseTo(2, 6);
    expect(points[1]?.error).toBe(kFloor);
  });
});

describe("logarithmic axes", () => {
  it("have room around what they show", () => {
    const { low, high } = logRange([3, 30]);
    expect(low).toBeLessThan(3);
    expect(high).toBeGreaterThan(30);
    const single = logRange([5]);
    expect(single.high / single.low).toBeCloseTo(4, 12);
    expect(logRange([])).toEqual({ low: 0.1, high: 10 });
  });

  it("have few round ticks", () => {
    expect(logTicks({ low: 0.8, high: 25 }, 6)).toEqual([1, 2, 5, 10, 20]);
    expect(logTicks({ low: 11, high: 40 }, 5)).toEqual([15, 20, 30, 40]);
    expect(logTicks({ low: 1e-5, high: 20 }, 5)).toEqual([1e-4, 1e-2, 1]);
    for (const high of [2, 9, 80, 1e3, 1e9]) {
      const ticks = logTicks({ low: 0.7, high }, 5);
      expect(ticks.length).toBeGreaterThan(0);
      expect(ticks.length).toBeLessThanOrEqual(5);
    }
  });
});

it("finds the point that a pointer means where several are close", () => {
  const places = [
    { left: 10, top: 10 },
    { left: 14, top: 10 },
  ];
  expect(nearest(places, { left: 11, top: 12 }, 20)).toBe(0);
  expect(nearest(places, { left: 13, top: 12 }, 20)).toBe(1);
  expect(nearest(places, { left: 50, top: 10 }, 20)).toBeUndefined();
  expect(nearest([], { left: 0, top: 0 }, 20)).toBeUndefined();
});
