import { describe, expect, it } from "vitest";
import { joined, takenApart } from "./apart";
import { sampleAt, type TransferFunction } from "./transfer_function";

const grey = (x: number) => ({ r: x, g: x, b: x });

const kMap: TransferFunction = [
  { value: 0, colour: grey(0), extinction: 0 },
  { value: 2, colour: grey(0.25), extinction: 3 },
  { value: 5, colour: grey(0.625), extinction: 1 },
  { value: 8, colour: grey(1), extinction: 2 },
];

describe("a map taken apart", () => {
  it("keeps the corners of each part alone", () => {
    const { colours, opacities } = takenApart(kMap);
    expect(colours.map((p) => p.value)).toEqual([0, 8]);
    expect(opacities.map((p) => p.value)).toEqual([0, 2, 5, 8]);
  });

  it("shows the same when it is joined again", () => {
    const again = joined(takenApart(kMap));
    expect(again.map((p) => p.value)).toEqual([0, 2, 5, 8]);
    again.forEach((point, i) => {
      expect(point.extinction).toBe(kMap[i]?.extinction);
      expect(point.colour.g).toBeCloseTo(kMap[i]?.colour.g ?? -1, 12);
    });
  });

  it("is joined whatever the lengths of its parts", () => {
    const { opacities } = takenApart(kMap);
    const colours = [0, 1, 3, 3.5, 7, 8].map((value) => ({
      value,
      colour: grey(value === 3 ? 1 : 0.1),
      extinction: 0,
    }));
    const map = joined({ colours, opacities });
    expect(map.map((p) => p.value)).toEqual([0, 1, 2, 3, 3.5, 5, 7, 8]);
    for (let value = 0; value <= 8; value += 0.125) {
      const sample = sampleAt(map, value);
      expect(sample.extinction).toBeCloseTo(sampleAt(opacities, value).extinction, 12);
      expect(sample.colour.r).toBeCloseTo(sampleAt(colours, value).colour.r, 12);
    }
  });

  it("keeps steps", () => {
    const steps: TransferFunction = [
      { value: 0, colour: grey(0), extinction: 1 },
      { value: 1, colour: grey(0), extinction: 1 },
      { value: 1, colour: grey(1), extinction: 1 },
      { value: 2, colour: grey(1), extinction: 1 },
    ];
    const apart = takenApart(steps);
    expect(apart.opacities).toHaveLength(2);
    expect(joined(apart)).toEqual(steps);
  });
});
