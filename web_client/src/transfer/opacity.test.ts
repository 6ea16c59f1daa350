import { describe, expect, it } from "vitest";
import { extinctionFromOpacity, opacityFromExtinction, referenceLengthOf } from "./opacity";

describe("opacity over a reference length", () => {
  it("is Beer and Lambert's law", () => {
    expect(opacityFromExtinction(Math.LN2, 1)).toBeCloseTo(0.5, 15);
    expect(opacityFromExtinction(0.1, 30)).toBeCloseTo(1 - Math.exp(-3), 15);
    expect(opacityFromExtinction(0, 7)).toBe(0);
  });

  it("comes back exactly, thin matter included", () => {
    for (const length of [1e-6, 0.37, 1e5]) {
      for (const depth of [1e-14, 1e-6, 0.5, 6]) {
        const sigma = depth / length;
        const back = extinctionFromOpacity(opacityFromExtinction(sigma, length), length);
        expect(Math.abs(back / sigma - 1)).toBeLessThan(1e-12);
      }
    }
  });

  it("falls back to one unit for data without extent", () => {
    expect(referenceLengthOf(50)).toBe(5);
    expect(referenceLengthOf(0)).toBe(1);
    expect(referenceLengthOf(Number.NaN)).toBe(1);
  });
});
