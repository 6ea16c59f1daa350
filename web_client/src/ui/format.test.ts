import { describe, expect, it } from "vitest";
import {
  formatBytes,
  formatCount,
  formatMs,
  formatNumber,
  formatValue,
  parseNumber,
  parseNumbers,
} from "./format";

describe("numbers for people", () => {
  it("have four digits and powers of ten where these are shorter", () => {
    expect(formatNumber(0)).toBe("0");
    expect(formatNumber(Math.PI)).toBe("3.142");
    expect(formatNumber(-12345)).toBe("-12350");
    expect(formatNumber(1234567)).toBe("1.235e6");
    expect(formatNumber(1e-9)).toBe("1e-9");
    expect(formatNumber(Number.NaN)).toBe("NaN");
    expect(formatValue(6.7e-15, 270)).toBe("0");
    expect(formatValue(6.7e-15, 1e-14)).toBe("6.7e-15");
  });

  it("count and weigh", () => {
    expect(formatCount(40960)).toBe("40,960");
    expect(formatCount(187395)).toBe("187 k");
    expect(formatCount(16777216)).toBe("16.8 M");
    expect(formatBytes(512)).toBe("512 B");
    expect(formatBytes(48 * 1024)).toBe("48 KB");
    expect(formatBytes(2.5 * 1024 ** 3)).toBe("2.5 GB");
    expect(formatMs(4.44)).toBe("4.4 ms");
    expect(formatMs(44.4)).toBe("44 ms");
  });

  it("are read as people type them", () => {
    expect(parseNumber(" 12,5 ")).toBe(12.5);
    expect(parseNumber("30 %")).toBe(30);
    expect(parseNumber("-1e3")).toBe(-1000);
    expect(parseNumber("")).toBeUndefined();
    expect(parseNumber("abc")).toBeUndefined();
    expect(parseNumber("Infinity")).toBeUndefined();
  });

  it("are read as lists with spaces, commas or semicolons between", () => {
    expect(parseNumbers("1, 2.5;3  -4e2,")).toEqual([1, 2.5, 3, -400]);
    expect(parseNumbers("  ")).toEqual([]);
    expect(parseNumbers("1, two")).toBeUndefined();
  });
});
