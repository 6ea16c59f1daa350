import { describe, expect, it } from "vitest";
import { isOwnMap, readMap, writeMap } from "./map_file";
import type { TransferFunction } from "./transfer_function";

const white = { r: 1, g: 1, b: 1 };
const map: TransferFunction = [
  { value: 0, colour: white, extinction: 0 },
  { value: 2, colour: { r: 0.25, g: 0, b: 1 }, extinction: 3 },
];

describe("a map in a file", () => {
  it("comes back as it was edited", () => {
    const edit = { map, density: 2, smooth: 0.5, apart: { colours: map, opacities: map } };
    const json = JSON.parse(JSON.stringify(writeMap(edit, map)));
    expect(isOwnMap(json)).toBe(true);
    expect(readMap(json)).toEqual(edit);
  });

  it("may have points alone", () => {
    expect(readMap({ points: [{ value: 1, colour: { r: 0.5 } }] })).toEqual({
      map: [{ value: 1, colour: { r: 0.5, g: 0, b: 0 }, extinction: 0 }],
      density: 1,
    });
  });

  it.each([
    [null, /the map is missing/],
    [{ points: [] }, /points is no list/],
    [{ points: [{ colour: white }] }, /points\[0\]\.value is no number/],
    [{ points: [{ value: 1 }] }, /points\[0\]\.colour is missing/],
    [{ points: [{ value: 1, colour: white, extinction: -1 }] }, /extinction is below 0/],
    [{ points: [map[1], map[0]] }, /points\[1\]\.value is below/],
    [{ points: map, editor: { map, density: 0 } }, /density is not above 0/],
    [{ points: map, editor: { map, apart: {} } }, /apart\.colours is no list/],
  ])("says what is wrong with %j", (json, reason) => {
    expect(() => readMap(json)).toThrow(reason);
  });
});
