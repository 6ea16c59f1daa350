import { expect, it } from "vitest";
import { Scale_Kind } from "../net/gen/volcast/v1/scene_pb";
import { axisOf, kStraight } from "../transfer/scale";
import { legendTicks } from "./legend_ticks";

const scale = (kind: Scale_Kind) =>
  ({ $typeName: "volcast.v1.Scale", kind, exponent: 0.5 }) as const;

it("puts round values between the ends, where the axis has them", () => {
  expect(legendTicks(kStraight, 0.02, 1.03).map((t) => t.value)).toEqual([0.02, 0.5, 1.03]);
  expect(legendTicks(kStraight, -50, 150).map((t) => t.value)).toEqual([-50, 0, 50, 100, 150]);
  const log = legendTicks(axisOf(scale(Scale_Kind.LOG), 0.5, 2e4), 0.5, 2e4);
  expect(log.map((t) => t.value)).toEqual([0.5, 10, 100, 1000, 20000]);
  expect(log[1]?.place).toBeCloseTo(Math.log(20) / Math.log(4e4), 12);
  const power = legendTicks(axisOf(scale(Scale_Kind.POWER), 0, 100), 0, 100);
  expect(power.find((t) => t.value === 25 || t.value === 50)?.place).toBeGreaterThan(0.49);
});

it("says one value where there is one", () => {
  expect(legendTicks(kStraight, 3, 3)).toEqual([{ value: 3, place: 0 }]);
});
