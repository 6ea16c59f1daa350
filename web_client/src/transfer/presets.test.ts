import { describe, expect, it } from "vitest";
import { colourOf, kColourMaps } from "./colour_maps";
import { opacityFromExtinction } from "./opacity";
import { defaultMap, kOpacityShapes, withColourMap, withOpacityShape } from "./presets";
import { encodeSrgb, fromHex, toHex } from "./srgb";
import { sampleAt, withMovedPoint, withPointAt } from "./transfer_function";

const start = defaultMap(-2, 6, 0.5);

describe("presets", () => {
  it("start over the whole range with viridis", () => {
    expect(start[0]?.value).toBe(-2);
    expect(start[start.length - 1]?.value).toBe(6);
    expect(toHex(sampleAt(start, -2).colour)).toBe("#440154");
    expect(toHex(sampleAt(start, 6).colour)).toBe("#fde725");
    expect(opacityFromExtinction(sampleAt(start, 6).extinction, 0.5)).toBeCloseTo(0.6, 12);
  });

  it("start with a range of positive length for a constant field", () => {
    const map = defaultMap(3, 3, 1);
    expect(map[0]?.value).toBeLessThan(map[map.length - 1]?.value ?? 0);
  });

  it("keep the extinction when the colours change, over and over", () => {
    const peak = withMovedPoint(withPointAt(start, 1.3).map, withPointAt(start, 1.3).index, 1.3, 9);
    let map = peak;
    for (const colours of [...kColourMaps, ...kColourMaps]) map = withColourMap(map, colours);
    for (let v = -2; v <= 6; v += 0.11) {
      expect(sampleAt(map, v).extinction).toBeCloseTo(sampleAt(peak, v).extinction, 9);
    }
    expect(map.length).toBeLessThanOrEqual(12);
  });

  it("keep the colours when the opacity changes", () => {
    for (const shape of kOpacityShapes) {
      const map = withOpacityShape(start, shape, 0.5);
      for (let v = -2; v <= 6; v += 0.11) {
        expect(sampleAt(map, v).colour.g).toBeCloseTo(sampleAt(start, v).colour.g, 6);
      }
      for (const [t, opacity] of shape.knots) {
        const at = sampleAt(map, -2 + 8 * t).extinction;
        expect(opacityFromExtinction(at, 0.5)).toBeCloseTo(opacity, 9);
      }
    }
  });

  it("hold only colours that a display can show", () => {
    for (const map of kColourMaps) {
      for (const stop of map.stops) expect(fromHex(toHex(stop))).toBeDefined();
      expect(colourOf(map, -1)).toEqual(map.stops[0]);
    }
  });

  it("rise steadily in lightness where they should", () => {
    for (const map of kColourMaps.filter((m) => m.id !== "cool-warm")) {
      const luma = map.stops.map((c) => 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
      luma.slice(1).forEach((y, i) => {
        expect(encodeSrgb(y)).toBeGreaterThan(encodeSrgb(luma[i] ?? 1));
      });
    }
  });
});
