import { describe, expect, it } from "vitest";
import { paintDifference, scaleColour } from "./difference_paint";

const colourAt = (rgba: Uint8ClampedArray, i: number): string =>
  `rgb(${rgba[4 * i]} ${rgba[4 * i + 1]} ${rgba[4 * i + 2]})`;

describe("a difference picture", () => {
  const off = Float32Array.of(0, 2 / 255, 4 / 255, 1, Number.POSITIVE_INFINITY, Number.NaN);
  const rgba = paintDifference(off, 4);

  it("has the scale's colours, up to its end", () => {
    expect(colourAt(rgba, 0)).toBe(scaleColour(0));
    expect(colourAt(rgba, 1)).toBe(scaleColour(0.5));
    for (const i of [2, 3, 4]) expect(colourAt(rgba, i)).toBe(scaleColour(1));
    expect(scaleColour(0)).not.toBe(scaleColour(1));
  });

  it("covers what is known alone", () => {
    expect([0, 1, 2, 3, 4, 5].map((i) => rgba[4 * i + 3])).toEqual([255, 255, 255, 255, 255, 0]);
  });

  it("is dark where there is no difference", () => {
    expect((rgba[0] ?? 255) + (rgba[1] ?? 255) + (rgba[2] ?? 255)).toBeLessThan(24);
  });
});
