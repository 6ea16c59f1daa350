import { describe, expect, it } from "vitest";
import { opacityFromExtinction } from "./opacity";
import { readPreset, writePreset } from "./paraview_map";
import { decodeSrgb, encodeSrgb } from "./srgb";
import { sampleAt, type TransferFunction } from "./transfer_function";

const byte = (x: number): number => Math.round(255 * encodeSrgb(x));
const bytesAt = (map: TransferFunction, value: number): number[] => {
  const { r, g, b } = sampleAt(map, value).colour;
  return [byte(r), byte(g), byte(b)];
};
const preset = (space: string, points: number[], more: object = {}) => [
  { Name: "p", ColorSpace: space, RGBPoints: points, ...more },
];

describe("a preset of ParaView", () => {
  it("goes straight in the display's numbers where it says RGB", () => {
    const { map, hasOpacity, name } = readPreset(preset("RGB", [2, 0, 0, 0, 4, 1, 0.5, 0]), 1);
    expect(name).toBe("p");
    expect(hasOpacity).toBe(false);
    expect(map[0]?.value).toBe(2);
    expect(map[map.length - 1]?.value).toBe(4);
    for (let i = 0; i <= 64; i += 1) {
      const t = i / 64;
      const { r, g } = sampleAt(map, 2 + 2 * t).colour;
      expect(Math.abs(encodeSrgb(r) - t)).toBeLessThan(0.51 / 255);
      expect(Math.abs(encodeSrgb(g) - t / 2)).toBeLessThan(0.51 / 255);
    }
  });

  // What ParaView 5 shows in the middle of "Cool to Warm": 0.865, 0.865, 0.865.
  it("passes grey where it is diverging", () => {
    const ends = [0, 0.231373, 0.298039, 0.752941, 1, 0.705882, 0.0156863, 0.14902];
    const { map } = readPreset(preset("Diverging", ends), 1);
    expect(bytesAt(map, 0)).toEqual([59, 76, 192]);
    for (const part of bytesAt(map, 0.5)) expect(Math.abs(part - 221)).toBeLessThanOrEqual(1);
    expect(bytesAt(map, 1)).toEqual([180, 4, 38]);
  });

  it("keeps grey grey in CIELAB: L* goes straight", () => {
    const { map } = readPreset(preset("Lab", [0, 0, 0, 0, 1, 1, 1, 1]), 1);
    const [r = 0, g = 0, b = 0] = bytesAt(map, 0.5);
    // L* = 50 is Y = ((50 + 16) / 116)^3.
    const grey = byte((66 / 116) ** 3);
    for (const part of [r, g, b]) expect(Math.abs(part - grey)).toBeLessThanOrEqual(1);
  });

  it("turns the hue the shorter way round", () => {
    const { map } = readPreset(preset("HSV", [0, 1, 0, 0.2, 1, 1, 0.2, 0]), 1);
    expect(bytesAt(map, 0.5)[0]).toBe(255);
    expect(Math.max(...bytesAt(map, 0.5).slice(1))).toBeLessThanOrEqual(1);
  });

  it("has opacities over a length", () => {
    const points = [0, 0, 0.5, 0, 1, 0.5, 0.5, 0];
    const { map, hasOpacity } = readPreset(
      preset("RGB", [0, 0, 0, 0, 1, 1, 1, 1], { Points: points }),
      3,
    );
    expect(hasOpacity).toBe(true);
    for (const value of [0, 0.1, 0.5, 0.93, 1]) {
      const opacity = opacityFromExtinction(sampleAt(map, value).extinction, 3);
      expect(Math.abs(opacity - value / 2)).toBeLessThan(1 / 1024);
    }
  });

  it.each([
    ["no map", [], /no colour map/],
    ["another space", preset("CAM", [0, 0, 0, 0, 1, 1, 1, 1]), /ColorSpace CAM is not one of RGB/],
    ["no points", preset("RGB", []), /RGBPoints is no list/],
    ["a point cut short", preset("RGB", [0, 0, 0, 0, 1]), /4 numbers a point/],
    ["a word", [{ RGBPoints: [0, "x", 0, 0] }], /RGBPoints\[1\] is no number/],
    ["values that fall", preset("RGB", [1, 0, 0, 0, 0, 1, 1, 1]), /do not ascend/],
    ["one value", preset("RGB", [1, 0, 0, 0, 1, 1, 1, 1]), /at one value/],
    [
      "midpoints",
      preset("RGB", [0, 0, 0, 0, 1, 1, 1, 1], { Points: [0, 0, 0.5, 0, 1, 1, 0.3, 0] }),
      /midpoints/,
    ],
  ])("is refused: %s", (_, json, reason) => {
    expect(() => readPreset(json, 1)).toThrow(reason);
  });
});

describe("a map that is written for ParaView", () => {
  it("comes back the same to a byte", () => {
    const map: TransferFunction = [
      { value: -1, colour: { r: 0, g: 0, b: 0 }, extinction: 0 },
      { value: 0.5, colour: { r: 1, g: decodeSrgb(0.5), b: 0 }, extinction: 2 },
      { value: 3, colour: { r: 0.1, g: 1, b: 0.9 }, extinction: 0.1 },
    ];
    const written = JSON.parse(JSON.stringify(writePreset(map, "mine", 0.7)));
    const { map: back, name } = readPreset(written, 0.7);
    expect(name).toBe("mine");
    for (let i = 0; i <= 200; i += 1) {
      const value = -1 + (4 * i) / 200;
      const [a, b] = [sampleAt(map, value), sampleAt(back, value)];
      for (const k of ["r", "g", "b"] as const) {
        const apart = Math.abs(encodeSrgb(a.colour[k]) - encodeSrgb(b.colour[k]));
        expect(apart).toBeLessThan(1.1 / 255);
      }
      const [x, y] = [a, b].map((p) => opacityFromExtinction(p.extinction, 0.7));
      expect(Math.abs((x ?? 0) - (y ?? 9))).toBeLessThan(1 / 255);
    }
  });
});
