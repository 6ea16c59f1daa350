import { describe, expect, it } from "vitest";
import { fromHalf, readHalves } from "./halves";

describe("binary16", () => {
  it.each([
    [0x0000, 0],
    [0x3c00, 1],
    [0xc000, -2],
    [0x0001, 2 ** -24],
    [0x03ff, 1023 * 2 ** -24],
    [0x0400, 2 ** -14],
    [0x7bff, 65504],
    [0x7c00, Number.POSITIVE_INFINITY],
    [0x7e00, Number.NaN],
  ])("%i is %d", (bits, value) => {
    expect(fromHalf(bits)).toBe(value);
  });

  it("is read with its low byte first", () => {
    expect([...readHalves(Uint8Array.of(0x00, 0x3c, 0x00, 0x38))]).toEqual([1, 0.5]);
  });
});
