import { describe, expect, it } from "vitest";
import { percentile, Ring, rate } from "./latencies";

describe("latencies", () => {
  it("takes percentiles by nearest rank", () => {
    const values = [5, 1, 4, 2, 3];
    expect(percentile(values, 0.5)).toBe(3);
    expect(percentile(values, 0.95)).toBe(5);
    expect(percentile(values, 0)).toBe(1);
    expect(percentile([], 0.5)).toBeUndefined();
  });

  it("keeps the newest values only", () => {
    const ring = new Ring(3);
    for (const x of [1, 2, 3, 4, 5]) ring.push(x);
    expect(ring.values()).toEqual([3, 4, 5]);
    ring.clear();
    expect(ring.values()).toEqual([]);
  });

  it("counts events in the window", () => {
    expect(rate([0, 900, 1000, 1500], 1900, 1000)).toBe(3);
  });
});
