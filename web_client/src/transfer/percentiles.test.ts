import { expect, it } from "vitest";
import { percentileOf } from "./percentiles";

it("finds percentiles, straight between those that are known", () => {
  const known = Array.from({ length: 101 }, (_, p) => p * p);
  expect(percentileOf(known, 0)).toBe(0);
  expect(percentileOf(known, 100)).toBe(10000);
  expect(percentileOf(known, 50)).toBe(2500);
  expect(percentileOf(known, 1.5)).toBeCloseTo(2.5, 12);
  expect(percentileOf([], 50)).toBeUndefined();
});
