import { describe, expect, it } from "vitest";
import { heightAtTarget, type Orbit } from "./camera";
import { roundLength, scaleBarOf } from "./scale_bar";

const orbit: Orbit = {
  target: [0, 0, 0],
  axis: [0, 0, 1],
  yaw: 0,
  pitch: 0,
  distance: 10,
  fovyDegrees: 40,
  orthographic: true,
};

describe("scale bar", () => {
  it("has round lengths", () => {
    expect([0.9, 1, 1.9, 2, 4.9, 5, 9.9, 10].map(roundLength)).toEqual([0.5, 1, 1, 2, 2, 5, 5, 10]);
    expect(roundLength(3.2e-7)).toBe(2e-7);
    expect(roundLength(1000)).toBe(1000);
    expect(roundLength(0)).toBe(0);
    expect(roundLength(Number.NaN)).toBe(0);
  });

  it("is as long on the screen as it says", () => {
    for (const distance of [1e-6, 0.3, 10, 4e5]) {
      const o = { ...orbit, distance };
      const bar = scaleBarOf(o, 500, 120);
      expect(bar.pixels).toBeLessThanOrEqual(120);
      expect(bar.pixels).toBeGreaterThan(120 / 2.5 - 1e-9);
      expect((bar.length / heightAtTarget(o)) * 500).toBeCloseTo(bar.pixels, 9);
    }
  });
});
