import { describe, expect, it } from "vitest";
import { kBackoff, waitMs } from "./backoff";

describe("reconnect back-off", () => {
  it("doubles from the first wait up to the longest", () => {
    const waits = [0, 1, 2, 3, 4, 5, 6, 60, 6000].map((n) => waitMs(n, 0));
    expect(waits).toEqual([250, 500, 1000, 2000, 4000, 8000, 10_000, 10_000, 10_000]);
  });

  it("spreads clients below the wait, never above it and never to nothing", () => {
    for (let n = 0; n < 12; n += 1) {
      const shortest = waitMs(n, 1);
      expect(shortest).toBeCloseTo(waitMs(n, 0) * (1 - kBackoff.spread), 9);
      expect(waitMs(n, 0.5)).toBeGreaterThan(shortest);
      expect(shortest).toBeGreaterThan(100);
    }
  });
});
