import { describe, expect, it } from "vitest";
import { kPadX, type PlotBox, valueAt, xOf } from "./map_plot";
import { boxWithin, kWhole, panned, zoomed } from "./map_zoom";

const box: PlotBox = {
  width: 220,
  low: 1,
  high: 100,
  axis: { along: Math.log, back: Math.exp, low: 1, high: 100 },
};

describe("zooming", () => {
  it("keeps what is pointed at in its place", () => {
    const near = zoomed(kWhole, 4, 0.3);
    const shown = boxWithin(box, near);
    const value = valueAt(box, kPadX + 0.3 * (box.width - 2 * kPadX));
    expect(xOf(shown, value)).toBeCloseTo(xOf(box, value), 9);
    expect(shown.low).toBeGreaterThan(1);
    expect(shown.high).toBeLessThan(100);
  });

  it("ends at the whole, and comes back to it exactly", () => {
    expect(zoomed(zoomed(kWhole, 8, 0.9), 1 / 16, 0.1)).toBe(kWhole);
    expect(boxWithin(box, kWhole)).toEqual(box);
    expect(panned(kWhole, 0.5)).toBe(kWhole);
  });

  it("moves no farther than the ends", () => {
    const near = zoomed(kWhole, 4, 0.5);
    expect(panned(near, 100).to).toBe(1);
    expect(panned(near, -100).from).toBe(0);
    expect(panned(near, 0.5).from).toBeCloseTo(near.from + 0.125, 12);
  });

  it("has an end", () => {
    let zoom = kWhole;
    for (let i = 0; i < 100; i += 1) zoom = zoomed(zoom, 10, 0.123);
    expect(zoom.to - zoom.from).toBeCloseTo(1e-4, 12);
    const { low, high } = boxWithin(box, zoom);
    expect(high).toBeGreaterThan(low);
  });
});
