import { describe, expect, it } from "vitest";
import type { Sample } from "../state/samples";
import { hudRows, lineOf, perSecond } from "./hud_series";

const sample = (at: number, more: Partial<Sample> = {}): Sample => ({
  at,
  latency: 20,
  render: 5,
  encode: 2,
  network: 3,
  decode: 1,
  bytes: 1000,
  quality: undefined,
  credits: undefined,
  ...more,
});

describe("performance charts", () => {
  it("count by half seconds up to now", () => {
    const series = perSecond([sample(19_900), sample(19_800), sample(100)], 20_000, (s) => s.bytes);
    expect(series).toHaveLength(40);
    expect(series[39]).toEqual([20_000, 4000]);
    expect(series[0]).toEqual([500, 2000]);
    expect(series[20]?.[1]).toBe(0);
  });

  it("show the last 20 s, and what is not told not at all", () => {
    const names = (samples: Sample[]): string[] => hudRows(samples, 30_000).map((r) => r.name);
    expect(names([sample(29_000)])).not.toContain("Quality");
    expect(names([sample(29_000, { quality: 80, credits: [1, 2] })])).toContain("Under way");
    const old = hudRows([sample(1000), sample(29_000, { latency: undefined })], 30_000);
    expect(old.find((r) => r.name === "Input to drawn")?.series).toEqual([]);
  });

  it("are lines from 0 to the largest", () => {
    expect(
      lineOf(
        [
          [0, 0],
          [10_000, 4],
          [20_000, 2],
        ],
        20_000,
      ),
    ).toBe("0.00,19.00 50.00,1.00 100.00,10.00");
    expect(lineOf([], 0)).toBe("");
  });
});
