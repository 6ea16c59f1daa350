import { describe, expect, it } from "vitest";
import { xxh32 } from "./xxh32";

const ascii = (text: string): Uint8Array => new TextEncoder().encode(text);

describe("XXH32", () => {
  it("gives the published values", () => {
    expect(xxh32(ascii(""))).toBe(0x02cc5d05);
    expect(xxh32(ascii("a"))).toBe(0x550d7456);
    expect(xxh32(ascii("abc"))).toBe(0x32d153ff);
    expect(xxh32(ascii("Nobody inspects the spammish repetition"))).toBe(0xe2293b2f);
  });

  it("gives the server's values of pixels, wherever they lie in memory", () => {
    expect(xxh32(Uint8Array.of(1, 2, 3, 4))).toBe(0xfe96d19c);
    const pixels = Uint8Array.from({ length: 83 }, (_, i) => i - 3);
    expect(xxh32(pixels.subarray(3))).toBe(0x24520b4f);
  });
});
