import { describe, expect, it } from "vitest";
import { bothOf } from "./apart";
import { kOpacityError } from "./drawn_map";
import { extinctionFromOpacity, opacityFromExtinction } from "./opacity";
import { kStraight } from "./scale";
import { smoothed, withCurvePointAt, withoutCurvePoint } from "./smooth_curve";
import { sampleAt, type TransferFunction } from "./transfer_function";

const black = { r: 0, g: 0, b: 0 };
const white = { r: 1, g: 1, b: 1 };
const peak: TransferFunction = [0, 2, 3, 4, 6].map((value, i) => ({
  value,
  colour: i === 2 ? white : black,
  extinction: extinctionFromOpacity(i === 2 ? 0.8 : 0, 0.5),
}));
const log = { along: Math.log, back: Math.exp, low: 0.1, high: 1e9 };

describe("smooth opacities", () => {
  it("keep the map's ends and colours, and round a peak off", () => {
    const smooth = smoothed(bothOf(peak), 0.5, kStraight);
    expect(smooth[0]?.value).toBe(0);
    expect(smooth[smooth.length - 1]?.value).toBe(6);
    expect(sampleAt(smooth, 3).colour.g).toBeCloseTo(1, 12);
    // In the middle of 5 points the two spans meet: (1/4 + 1/4) of neighbours, 1/2 of the point.
    const top = opacityFromExtinction(sampleAt(smooth, 3).extinction, 0.5);
    expect(Math.abs(top - 0.4)).toBeLessThan(kOpacityError);
  });

  it("of two points are straight", () => {
    const ends = [peak[0], peak[2]].map((p) => p as (typeof peak)[0]);
    const middle = sampleAt(smoothed(bothOf(ends), 0.5, kStraight), 1.5);
    const opacity = opacityFromExtinction(middle.extinction, 0.5);
    expect(Math.abs(opacity - 0.4)).toBeLessThan(kOpacityError);
  });

  it.each([
    [kStraight, 0],
    [log, 1],
  ])("are sent as before, to 32 bits, while points are added and not moved", (axis, shift) => {
    const map = peak.map((p) => ({ ...p, value: p.value + shift }));
    const apart = bothOf(map);
    const numbers = (drawn: TransferFunction) =>
      drawn.flatMap(({ value, extinction }) => [value, extinction].map(Math.fround));
    const before = numbers(smoothed(apart, 0.5, axis));
    let curve = { ...apart, distance: 0.5, axis };
    for (const x of [0.3, 2.5, 2.6, 4.4, 5.9]) {
      const { opacities, knots } = withCurvePointAt(curve, x + shift);
      curve = { ...curve, opacities, knots };
      expect(numbers(smoothed({ ...apart, opacities, knots }, 0.5, axis))).toEqual(before);
    }
    expect(curve.opacities).toHaveLength(10);
    expect(curve.opacities[0]).toBe(apart.opacities[0]);
    for (let count = 9; count >= 5; count -= 1) {
      const { opacities, knots } = withoutCurvePoint(curve, count >> 1);
      curve = { ...curve, opacities, knots };
      expect(curve.opacities).toHaveLength(count);
    }
    expect(numbers(smoothed({ ...apart, ...curve }, 0.5, axis))).toEqual(before);
  });
});
