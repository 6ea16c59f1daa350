import { describe, expect, it } from "vitest";
import { sampleAt } from "../transfer/transfer_function";
import {
  asDrawn,
  type ControlMap,
  withControlPart,
  withControlPoint,
  withoutControlPoint,
} from "./control_map";

const red = { r: 1, g: 0, b: 0 };
const blue = { r: 0, g: 0, b: 1 };
const kMap: ControlMap = {
  window: { min: 0, max: 10 },
  points: [
    { value: 2, colour: red, opacity: 0.25 },
    { value: 6, colour: blue, opacity: 0.75 },
  ],
};

describe("a transferFunction control", () => {
  it("is drawn as the code sees it: nothing below the first point, the last one above", () => {
    const drawn = asDrawn(kMap);
    expect(sampleAt(drawn, 1.99).extinction).toBe(0);
    expect(sampleAt(drawn, 4)).toEqual({
      value: 4,
      colour: { r: 0.5, g: 0, b: 0.5 },
      extinction: 0.5,
    });
    expect(sampleAt(drawn, 9).extinction).toBe(0.75);
    expect(asDrawn({ ...kMap, points: [] })).toEqual([]);
  });

  it("takes a point that changes nothing, or one in the usual colour where there is nothing", () => {
    const inner = withControlPoint(kMap, 4, red);
    expect(inner.index).toBe(1);
    expect(inner.map.points[1]).toEqual({
      value: 4,
      colour: { r: 0.5, g: 0, b: 0.5 },
      opacity: 0.5,
    });
    const first = withControlPoint({ ...kMap, points: [] }, 5, blue);
    expect(first.map.points).toEqual([{ value: 5, colour: blue, opacity: 0 }]);
    expect(withControlPoint(kMap, 1, blue).map.points[0]?.opacity).toBe(0);
  });

  it("keeps points between their neighbours, in the window, and opacities from 0 to 1", () => {
    expect(withControlPart(kMap, 0, { value: 8 }).points[0]?.value).toBe(6);
    expect(withControlPart(kMap, 1, { value: 12 }).points[1]?.value).toBe(10);
    expect(withControlPart(kMap, 1, { opacity: 1.5 }).points[1]?.opacity).toBe(1);
    expect(withControlPart(kMap, 0, { value: Number.NaN }).points[0]?.value).toBe(2);
    expect(withControlPart(kMap, 7, { value: 1 })).toBe(kMap);
  });

  it("lets go of any point", () => {
    expect(withoutControlPoint(kMap, 0).points).toHaveLength(1);
  });
});
