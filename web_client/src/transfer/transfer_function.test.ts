import { describe, expect, it } from "vitest";
import {
  sampleAt,
  scaled,
  stretched,
  type TransferFunction,
  withColour,
  withMovedPoint,
  withoutIdlePoints,
  withoutPoint,
  withPointAt,
  withReversedColours,
} from "./transfer_function";

const black = { r: 0, g: 0, b: 0 };
const white = { r: 1, g: 1, b: 1 };
const ramp: TransferFunction = [
  { value: 0, colour: black, extinction: 0 },
  { value: 10, colour: white, extinction: 2 },
];

describe("transfer function", () => {
  it("is piecewise linear and clamped outside", () => {
    expect(sampleAt(ramp, 2.5).extinction).toBeCloseTo(0.5, 15);
    expect(sampleAt(ramp, 2.5).colour.g).toBeCloseTo(0.25, 15);
    expect(sampleAt(ramp, -1).extinction).toBe(0);
    expect(sampleAt(ramp, 11).extinction).toBe(2);
  });

  it("gets a new point without changing anywhere", () => {
    const { map, index } = withPointAt(ramp, 3);
    expect(index).toBe(1);
    expect(map).toHaveLength(3);
    for (let v = -1; v <= 11; v += 0.37) {
      expect(sampleAt(map, v).extinction).toBeCloseTo(sampleAt(ramp, v).extinction, 12);
      expect(sampleAt(map, v).colour.r).toBeCloseTo(sampleAt(ramp, v).colour.r, 12);
    }
  });

  it("selects the point that is already there", () => {
    expect(withPointAt(ramp, 10)).toEqual({ map: ramp, index: 1 });
  });

  it("moves inner points between their neighbours and ends only up and down", () => {
    const { map } = withPointAt(ramp, 3);
    expect(withMovedPoint(map, 1, 99, 1)[1]).toMatchObject({ value: 10, extinction: 1 });
    expect(withMovedPoint(map, 1, -99, -5)[1]).toMatchObject({ value: 0, extinction: 0 });
    expect(withMovedPoint(map, 0, 5, 1)[0]).toMatchObject({ value: 0, extinction: 1 });
    expect(withMovedPoint(map, 2, 5, 1)[2]).toMatchObject({ value: 10, extinction: 1 });
    expect(withMovedPoint(map, 1, Number.NaN, Number.NaN)).toEqual(map);
  });

  it("deletes inner points and keeps its ends", () => {
    const { map } = withPointAt(ramp, 3);
    expect(withoutPoint(map, 1)).toEqual(ramp);
    expect(withoutPoint(map, 0)).toBe(map);
    expect(withoutPoint(map, 2)).toBe(map);
  });

  it("recolours one point only", () => {
    const map = withColour(ramp, 0, white);
    expect(map[0]?.colour).toEqual(white);
    expect(map[1]).toBe(ramp[1]);
  });

  it("scales density and stretches over a new range", () => {
    expect(scaled(ramp, 0.5)[1]?.extinction).toBe(1);
    const wide = stretched(withPointAt(ramp, 5).map, -1, 3);
    expect(wide.map((p) => p.value)).toEqual([-1, 1, 3]);
    expect(wide[2]?.extinction).toBe(2);
  });

  it("draws a step where two points share a value", () => {
    const step: TransferFunction = [
      { value: 0, colour: black, extinction: 0 },
      { value: 5, colour: black, extinction: 0 },
      { value: 5, colour: white, extinction: 2 },
      { value: 10, colour: white, extinction: 2 },
    ];
    expect(sampleAt(step, 4.999).extinction).toBe(0);
    expect(sampleAt(step, 5.001).extinction).toBe(2);
  });

  it("is turned round by a range that runs from high to low", () => {
    const turned = stretched(ramp, 4, 2);
    expect(turned.map((p) => p.value)).toEqual([2, 4]);
    expect(turned[0]?.extinction).toBe(2);
    expect(sampleAt(turned, 2.5).extinction).toBeCloseTo(1.5, 12);
  });

  it("keeps its shape along a logarithmic axis", () => {
    const axis = { along: Math.log, back: Math.exp, low: 0.1, high: 1e9 };
    const map = [...ramp].map((p, i) => ({ ...p, value: [1, 100][i] ?? 0 }));
    const middle = withPointAt(map, 10, axis.along).map;
    expect(stretched(middle, 1, 1e4, axis)[1]?.value).toBeCloseTo(100, 9);
  });
});

describe("points that change nothing", () => {
  const bent: TransferFunction = [
    { value: -3, colour: black, extinction: 0.1 },
    { value: 1, colour: { r: 0.3, g: 0.7, b: 0.1 }, extinction: 2.7 },
    { value: 1, colour: { r: 0.4, g: 0.7, b: 0.1 }, extinction: 2.7 },
    { value: 7.1, colour: white, extinction: 0 },
  ];

  it("leave what is drawn as it is to the last bit, however many there are", () => {
    const drawn = withoutIdlePoints(bent);
    expect(drawn).toEqual(bent);
    let map = bent;
    for (let i = 0; i < 200; i += 1) map = withPointAt(map, -3 + 10.1 * ((i * 0.618) % 1)).map;
    expect(map.length).toBeGreaterThan(190);
    expect(withoutIdlePoints(map)).toEqual(drawn);
  });

  it("are found on logarithmic axes, too", () => {
    const axis = { along: Math.log, back: Math.exp, low: 1e-3, high: 1e3 };
    const map = withPointAt(
      [
        { value: 1e-3, colour: black, extinction: 0 },
        { value: 1e3, colour: white, extinction: 5 },
      ],
      0.37,
      axis.along,
    ).map;
    expect(withoutIdlePoints(map, axis.along)).toHaveLength(2);
    expect(withoutIdlePoints(map)).toHaveLength(3);
  });

  it("are not those that were moved by little", () => {
    const { map, index } = withPointAt(ramp, 3);
    const point = map[index];
    const moved = withMovedPoint(map, index, 3, (point?.extinction ?? 0) * (1 + 1e-6));
    expect(withoutIdlePoints(moved)).toHaveLength(3);
  });
});

describe("reversed colours", () => {
  const map: TransferFunction = [
    { value: 0, colour: black, extinction: 1 },
    { value: 2, colour: { r: 1, g: 0, b: 0 }, extinction: 5 },
    { value: 10, colour: white, extinction: 2 },
  ];

  it("run from the last to the first, and opacity stays", () => {
    const turned = withReversedColours(map);
    for (const value of [0, 1, 2, 5, 8, 9, 10]) {
      expect(sampleAt(turned, value).extinction).toBeCloseTo(sampleAt(map, value).extinction, 12);
      const [a, b] = [sampleAt(turned, value).colour, sampleAt(map, 10 - value).colour];
      for (const k of ["r", "g", "b"] as const) expect(a[k]).toBeCloseTo(b[k], 12);
    }
  });

  it("are as before when they are reversed twice", () => {
    const twice = withReversedColours(withReversedColours(map));
    expect(twice.map((p) => p.value)).toEqual([0, 2, 10]);
  });
});
