import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { ClipPlaneSchema } from "../net/gen/volcast/v1/scene_pb";
import { type AxisIndex, axisPlaneOf, nextPlane, planeMessage } from "./clip_planes";

describe("clip planes", () => {
  it("keep what lies on the named side", () => {
    for (const axis of [0, 1, 2] as readonly AxisIndex[]) {
      for (const below of [false, true]) {
        const { normal, offset } = planeMessage({ axis, position: 3, below });
        const kept = (at: number): boolean => {
          const p = [0, 0, 0].map((_, i) => (i === axis ? at : 50));
          const dot =
            (normal?.x ?? 0) * (p[0] ?? 0) +
            (normal?.y ?? 0) * (p[1] ?? 0) +
            (normal?.z ?? 0) * (p[2] ?? 0);
          return dot >= offset;
        };
        expect([kept(2.9), kept(3.1)]).toEqual([below, !below]);
      }
    }
  });

  it("are read back, other lengths of the normal included", () => {
    const plane = { axis: 1 as const, position: -2, below: true };
    expect(axisPlaneOf(planeMessage(plane))).toEqual(plane);
    const long = create(ClipPlaneSchema, { normal: { x: 0, y: -4, z: 0 }, offset: 8 });
    expect(axisPlaneOf(long)).toEqual(plane);
    const oblique = create(ClipPlaneSchema, { normal: { x: 1, y: 1, z: 0 }, offset: 8 });
    expect(axisPlaneOf(oblique)).toBeUndefined();
    expect(axisPlaneOf(create(ClipPlaneSchema))).toBeUndefined();
  });

  it("start in the middle, across the first axis without one", () => {
    const bounds = { min: [0, 2, 4], max: [2, 4, 8] } as const;
    const first = nextPlane([], bounds);
    expect(first).toMatchObject({ axis: 0, position: 1 });
    expect(nextPlane([planeMessage(first)], bounds)).toMatchObject({ axis: 1, position: 3 });
  });
});
