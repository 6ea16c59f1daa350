import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { Scale_Kind, ScaleSchema } from "../net/gen/volcast/v1/scene_pb";
import { axisOf, kStraight, positiveDomain } from "./scale";
import { sampleAt, withPointAt } from "./transfer_function";

const scale = (kind: Scale_Kind, exponent = 0, domain?: { min: number; max: number }) =>
  create(ScaleSchema, { kind, exponent, domain });

describe("scale", () => {
  it("goes there and back", () => {
    for (const s of [scale(Scale_Kind.LOG), scale(Scale_Kind.POWER, 0.5), undefined]) {
      const { along, back } = axisOf(s, 2, 50);
      for (const value of [2, 7, 50]) expect(back(along(value))).toBeCloseTo(value, 9);
    }
    expect(axisOf(scale(Scale_Kind.POWER, 2), 0, 4).along(2)).toBe(0.25);
  });

  it("is straight where it has no meaning", () => {
    expect(axisOf(scale(Scale_Kind.LOG), -1, 5)).toBe(kStraight);
    expect(axisOf(scale(Scale_Kind.POWER, -1), 0, 5)).toBe(kStraight);
    expect(axisOf(scale(Scale_Kind.LOG), 5, 5)).toBe(kStraight);
  });

  it("clamps to its domain", () => {
    const { along } = axisOf(scale(Scale_Kind.LOG, 0, { min: 1, max: 10 }), -5, 100);
    expect([along(-5), along(100)]).toEqual([0, Math.log(10)]);
  });

  it("needs a domain for logarithms where a field goes down to 0", () => {
    expect(positiveDomain(0, 10)).toEqual({ min: 0.01, max: 10 });
    expect(positiveDomain(1, 10)).toBeUndefined();
    expect(positiveDomain(-2, 0)).toBeUndefined();
  });

  it("is what maps are straight in", () => {
    const black = { r: 0, g: 0, b: 0 };
    const map = [
      { value: 1, colour: black, extinction: 0 },
      { value: 100, colour: black, extinction: 2 },
    ];
    const { along } = axisOf(scale(Scale_Kind.LOG), 1, 100);
    expect(sampleAt(map, 10, along).extinction).toBeCloseTo(1, 12);
    expect(withPointAt(map, 10, along).map[1]?.extinction).toBeCloseTo(1, 12);
    expect(sampleAt(map, 10).extinction).toBeCloseTo(18 / 99, 12);
  });
});
