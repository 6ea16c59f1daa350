import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { Levels_Spacing, LevelsSchema } from "../net/gen/volcast/v1/scene_pb";
import { isEmpty, kindOf, middleLevel, movedTo, valuesOf, withKind } from "./levels";

const range = { min: 0, max: 8 };
const run = (spacing: Levels_Spacing, first: number, last: number, exponent = 0) =>
  create(LevelsSchema, { spacing, first, last, count: 3, exponent });

describe("levels", () => {
  it("stand for the values that the protocol gives them", () => {
    expect(valuesOf(middleLevel(range))).toEqual([4]);
    expect(valuesOf(run(Levels_Spacing.LINEAR, 1, 3))).toEqual([1, 2, 3]);
    expect(valuesOf(run(Levels_Spacing.LOG, 1, 100)).map((v) => Math.round(v))).toEqual([
      1, 10, 100,
    ]);
    expect(valuesOf(run(Levels_Spacing.POWER, 1, 5))).toEqual([1, 2, 5]); // Exponent 2.
    expect(valuesOf(run(Levels_Spacing.POWER, 1, 9, 3))).toEqual([1, 2, 9]);
    expect(valuesOf(run(Levels_Spacing.LOG, -1, 100))).toEqual([]);
    expect(isEmpty(create(LevelsSchema))).toBe(true);
    expect(isEmpty(middleLevel(range))).toBe(false);
  });

  it("are told another way without being moved, as far as that goes", () => {
    const even = withKind(middleLevel(range), "linear", range);
    expect([kindOf(even), even.first, even.last, even.count]).toEqual(["linear", 2, 6, 5]);
    const list = withKind(even, "list", range);
    expect([kindOf(list), list.values]).toEqual(["list", [2, 3, 4, 5, 6]]);
    const one = withKind(list, "one", range);
    expect([kindOf(one), one.values]).toEqual(["one", [4]]);
    expect(withKind(one, "list", range).values).toEqual([2, 4]);
    expect(kindOf(create(LevelsSchema))).toBe("list"); // So that an emptied list can be filled.
    const logs = withKind(even, "log", { min: -8, max: 8 });
    expect([logs.first, logs.last]).toEqual([2, 6]);
    expect(withKind(one, "log", { min: -8, max: 8 }).first).toBeGreaterThan(0);
  });

  it("go to the same places of another field", () => {
    const moved = movedTo(create(LevelsSchema, { values: [2, 4] }), range, { min: -1, max: 1 });
    expect(moved.values).toEqual([-0.5, 0]);
  });
});
