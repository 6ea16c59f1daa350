import { describe, expect, it } from "vitest";
import { h264Name } from "./codecs";

describe("H.264's name", () => {
  it("is read from the parameter set, wherever it lies", () => {
    const start = [0, 0, 0, 1];
    const access = [...start, 9, 0x10];
    expect(h264Name(Uint8Array.from([...start, 0x67, 0x42, 0xc0, 0x1f, 1, 2]))).toBe("avc1.42c01f");
    expect(h264Name(Uint8Array.from([...access, 0, 0, 1, 0x27, 0x64, 0, 0x0a, 1, 2]))).toBe(
      "avc1.64000a",
    );
  });

  it("is not known of other pictures", () => {
    expect(h264Name(Uint8Array.from([0, 0, 0, 1, 0x41, 1, 2, 3, 4, 5]))).toBeUndefined();
    expect(h264Name(Uint8Array.of())).toBeUndefined();
  });
});
