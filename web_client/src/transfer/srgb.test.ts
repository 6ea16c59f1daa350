import { describe, expect, it } from "vitest";
import { decodeSrgb, encodeSrgb, fromHex, mixColour, toHex } from "./srgb";

describe("sRGB", () => {
  it("meets the standard's fixed points", () => {
    expect(encodeSrgb(0)).toBe(0);
    expect(encodeSrgb(1)).toBeCloseTo(1, 12);
    expect(encodeSrgb(0.0031308)).toBeCloseTo(0.04045, 5);
    expect(encodeSrgb(0.214041)).toBeCloseTo(0.5, 5);
  });

  it("is undone by its inverse for every byte", () => {
    for (let i = 0; i < 256; i += 1) {
      expect(Math.round(255 * encodeSrgb(decodeSrgb(i / 255)))).toBe(i);
    }
  });

  it("keeps every hex colour through linear light", () => {
    for (const hex of ["#000000", "#ffffff", "#3aa6a0", "#010203", "#fe8040"]) {
      const colour = fromHex(hex);
      expect(colour && toHex(colour)).toBe(hex);
    }
  });

  it("clamps what a display cannot show and refuses what is no colour", () => {
    expect(toHex({ r: 2, g: -1, b: 0.5 })).toBe("#ff00bc");
    expect(fromHex("#12345")).toBeUndefined();
    expect(fromHex("red")).toBeUndefined();
  });

  it("mixes in linear light", () => {
    const grey = mixColour({ r: 0, g: 0, b: 0 }, { r: 1, g: 1, b: 1 }, 0.5);
    expect(toHex(grey)).toBe("#bcbcbc");
  });
});
