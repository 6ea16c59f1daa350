import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { LayerSchema, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { DatasetInfoSchema } from "../net/gen/volcast/v1/session_pb";
import { alongAxis, type Orbit } from "../view/camera";
import { projected } from "../view/project";
import { endGesture, undo } from "./actions";
import { createAppState } from "./app_state";
import { boxDraggedBy, boxMoveByKey, boxOf, middleOfBox, moveBox } from "./clip_box";
import { boxPlanes } from "./clip_handles";
import { planeMessage } from "./clip_planes";
import { startHistory } from "./history";

const bounds = { min: [0, 0, 0], max: [10, 20, 40] } as const;
const orbit: Orbit = {
  target: [5, 10, 20],
  axis: [0, 0, 1],
  yaw: 0.3,
  pitch: 0.2,
  distance: 90,
  fovyDegrees: 35,
  orthographic: false,
};

function opened() {
  const state = createAppState();
  const [min, max] = [
    { x: 0, y: 0, z: 0 },
    { x: 10, y: 20, z: 40 },
  ];
  state.datasets.value = [create(DatasetInfoSchema, { id: "d", boundsMin: min, boundsMax: max })];
  const layers = [create(LayerSchema, { id: "a", dataset: "d" })];
  const scene = create(SceneSchema, { layers, clipPlanes: boxPlanes(bounds) });
  state.edit.value = startHistory({ scene, map: [], density: 1 });
  return { state, box: () => boxOf(state.scene.value?.clipPlanes ?? []) };
}

describe("a clip box", () => {
  it("is six faces, whatever their order, and nothing less", () => {
    const planes = boxPlanes(bounds);
    expect(boxOf([...planes].reverse())).toEqual({ min: [0.5, 1, 2], max: [9.5, 19, 38] });
    expect(boxOf(planes.slice(1))).toBeUndefined();
    const twice = [...planes.slice(1), planeMessage({ axis: 1, position: 3, below: false })];
    expect(boxOf(twice)).toBeUndefined();
  });

  it("moves as it is, stops at the data's bounds, and is back by one step", () => {
    const { state, box } = opened();
    const start = box();
    if (!start) throw new Error("there is no box");
    moveBox(state, start, [0.25, 0, -1]);
    moveBox(state, start, [99, -0.5, -99]);
    endGesture(state);
    expect(box()).toEqual({ min: [1, 0.5, 0], max: [10, 18.5, 36] });
    undo(state);
    expect(box()).toEqual(start);
  });

  it("stays under the hand that drags it", () => {
    const box = { min: [2, 3, 5], max: [4, 9, 11] } as const;
    const from = projected(orbit, middleOfBox(box));
    if (!from) throw new Error("it lies behind the eye");
    const to = { x: from.x + 0.2, y: from.y - 0.1 };
    const [x, y, z] = boxDraggedBy({ box, orbit, from }, to);
    const [a, b, c] = middleOfBox(box);
    const seen = projected(orbit, [a + x, b + y, c + z]);
    expect(seen?.x).toBeCloseTo(to.x, 12);
    expect(seen?.y).toBeCloseTo(to.y, 12);
  });

  it("goes along a world axis by each key, whichever way one looks", () => {
    for (const axis of [0, 1, 2] as const) {
      for (const behind of [false, true]) {
        const seen = alongAxis(orbit, axis, behind);
        const moves = ["ArrowRight", "ArrowUp", "PageUp"].map((key) =>
          boxMoveByKey(seen, bounds, key, false),
        );
        const axes = moves.map((by) => by?.findIndex((x) => x !== 0));
        expect([...axes].sort()).toEqual([0, 1, 2]);
        const before = projected(seen, [5, 10, 20]);
        const [x = 0, y = 0, z = 0] = moves[0] ?? [];
        const after = projected(seen, [5 + x, 10 + y, 20 + z]);
        expect(after?.x).toBeGreaterThan(before?.x ?? 0);
      }
    }
    expect(boxMoveByKey(alongAxis(orbit, 0, false), bounds, "Enter", false)).toBeUndefined();
    const coarse = boxMoveByKey(orbit, bounds, "ArrowUp", false)?.[2] ?? 0;
    expect(boxMoveByKey(orbit, bounds, "ArrowUp", true)?.[2]).toBeCloseTo(coarse / 10, 12);
    expect(coarse).toBeCloseTo(0.4, 12);
  });
});
