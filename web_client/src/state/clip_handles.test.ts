import { create } from "@bufbuild/protobuf";
import { beforeEach, describe, expect, it } from "vitest";
import { ClipPlaneSchema, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { DatasetInfoSchema } from "../net/gen/volcast/v1/session_pb";
import type { Bounds } from "../view/camera";
import { projected } from "../view/project";
import { add, times, type Vec3 } from "../view/vec3";
import { adoptScene, undo } from "./actions";
import { type AppState, createAppState } from "./app_state";
import {
  boxPlanes,
  draggedTo,
  type Handle,
  handleOf,
  moveHandle,
  placeByKey,
  removePlane,
} from "./clip_handles";
import { axisPlaneOf, planeMessage } from "./clip_planes";

const kBounds: Bounds = { min: [0, 0, 0], max: [2, 4, 6] };
const across = planeMessage({ axis: 1, position: 1, below: true });
const oblique = create(ClipPlaneSchema, { normal: { x: 3, y: 4, z: 0 }, offset: 5 });

function handle(message: typeof across): Handle {
  const found = handleOf(message, 0, kBounds);
  if (!found) throw new Error("the plane has no handle");
  return found;
}

let state: AppState;
beforeEach(() => {
  state = createAppState();
  state.datasets.value = [
    create(DatasetInfoSchema, { id: "d", boundsMin: {}, boundsMax: { x: 2, y: 4, z: 6 } }),
  ];
  const camera = { eye: { x: 9, y: -9, z: 5 }, center: {}, up: { z: 1 }, fovyDegrees: 30 };
  const layers = [{ id: "a", dataset: "d" }];
  adoptScene(state, create(SceneSchema, { camera, layers, clipPlanes: [across, oblique] }));
});
const planes = () => state.scene.value?.clipPlanes ?? [];

describe("a clip plane's handle", () => {
  it("moves along the axis, whichever side is kept", () => {
    expect(handle(across).along.map((c) => c + 0)).toEqual([0, 1, 0]);
    expect(handle(across)).toMatchObject({
      name: "Clip plane 1, Y",
      place: 1,
      low: 0,
      high: 4,
      at: [1, 1, 3],
    });
  });

  it("of an oblique plane moves along its normal, in world units", () => {
    const { along, place, low, high } = handle(oblique);
    expect(along[0]).toBeCloseTo(0.6, 12);
    expect(along[1]).toBeCloseTo(0.8, 12);
    expect([place, low]).toEqual([1, 0]);
    expect(high).toBeCloseTo(4.4, 12);
  });

  it("does not exist for a plane without a normal", () => {
    expect(handleOf(create(ClipPlaneSchema, {}), 0, kBounds)).toBeUndefined();
  });

  it("moves its plane within the data, as one step however it is moved", () => {
    moveHandle(state, 0, 3);
    moveHandle(state, 0, 99);
    expect(axisPlaneOf(planes()[0] ?? across)).toEqual({ axis: 1, position: 4, below: true });
    undo(state);
    expect(planes()[0]).toEqual(across);
    moveHandle(state, 1, 2);
    expect(planes()[1]?.offset).toBe(10);
    removePlane(state, 0);
    expect(planes().length).toBe(1);
  });

  it("follows the hand that holds it, wherever it was taken", () => {
    const { value: orbit } = state.orbit;
    if (!orbit) throw new Error("there is no camera");
    for (const message of [across, oblique]) {
      const held = handle(message);
      const to: Vec3 = add(held.at, times(held.along, 0.5));
      const [from, there] = [projected(orbit, held.at), projected(orbit, to)];
      if (!from || !there) throw new Error("the handle is behind the eye");
      expect(draggedTo({ handle: held, orbit, from }, there)).toBeCloseTo(held.place + 0.5, 9);
    }
  });

  it("moves by keys: a hundredth, with Shift a thousandth, and to the ends", () => {
    const held = handle(across);
    expect(placeByKey(held, "ArrowUp", false)).toBeCloseTo(1.04, 12);
    expect(placeByKey(held, "ArrowLeft", true)).toBeCloseTo(0.996, 12);
    expect(placeByKey(held, "PageDown", false)).toBeCloseTo(0.6, 12);
    expect(placeByKey(held, "Home", false)).toBe(0);
    expect(placeByKey(held, "End", false)).toBe(4);
    expect(placeByKey(held, "a", false)).toBeUndefined();
  });
});

describe("a clip box", () => {
  it("has two planes across each axis, which keep what lies between them", () => {
    const box = boxPlanes(kBounds).map(axisPlaneOf);
    expect(box.map((p) => p?.axis)).toEqual([0, 0, 1, 1, 2, 2]);
    expect(box.map((p) => p?.below)).toEqual([false, true, false, true, false, true]);
    expect(box[2]?.position).toBeCloseTo(0.2, 12);
    expect(box[3]?.position).toBeCloseTo(3.8, 12);
  });
});
