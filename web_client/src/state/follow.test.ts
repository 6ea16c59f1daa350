import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { LayerSchema, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { bothOf } from "../transfer/apart";
import { dragged, frameOf, type Orbit } from "../view/camera";
import { rolled } from "../view/turning";
import { createAppState, type Edit } from "./app_state";
import { editOf, followScene, joinScene, orbitAbout, sameMap } from "./follow";
import { startHistory } from "./history";
import { cameraMessage, sceneMessage } from "./scene_message";

const colour = { r: 0.1, g: 0.7, b: 0.3 };
const map = [
  { value: 0, colour, extinction: 0 },
  { value: 0.3, colour, extinction: 0.7 },
  { value: 1, colour, extinction: 2 },
];
const orbit: Orbit = {
  target: [1, 2, 3],
  axis: [0, 0, 1],
  yaw: 0.4,
  pitch: 0.9,
  distance: 5,
  fovyDegrees: 35,
  orthographic: false,
};
const base = create(SceneSchema, { layers: [create(LayerSchema, { id: "a", dataset: "d" })] });
const edit: Edit = { scene: base, map, density: 3, smooth: 0.5 };
const sent = sceneMessage(base, orbit, undefined, edit);
/** As the server sends it back: colours and extinctions have passed through 32 bits. */
const received = create(SceneSchema, {
  ...sent,
  layers: sent.layers.map((layer) => ({
    ...layer,
    transferFunction: layer.transferFunction && {
      ...layer.transferFunction,
      points: layer.transferFunction.points.map((p) => ({
        ...p,
        extinction: Math.fround(p.extinction),
      })),
    },
  })),
});

describe("scenes of the server", () => {
  it("are edited as they were when their map was made here", () => {
    const found = editOf(received, [{ ...edit, density: 2 }, edit]);
    expect(found).toMatchObject({ map, density: 3, smooth: 0.5 });
    expect(found.scene).toBe(received);
  });

  it("are edited by the points that they have, where those came from elsewhere", () => {
    const found = editOf(received, [{ ...edit, density: 2 }]);
    expect(found.density).toBe(1);
    expect(found.map.length).toBe(received.layers[0]?.transferFunction?.points.length);
    expect(found.smooth).toBeUndefined();
  });

  it("are edited as their file says, as long as that draws what they show", () => {
    for (const [density, found] of [
      [3, 3],
      [2, 1],
    ] as const) {
      const state = createAppState();
      joinScene(state, received, { map, density, smooth: 0.5, apart: bothOf(map) });
      expect(state.edit.value.present.density).toBe(found);
      expect(state.edit.value.present.smooth).toBe(found === 3 ? 0.5 : undefined);
    }
  });

  it("tells maps apart by more than rounding alone", () => {
    expect(sameMap(map, map)).toBe(true);
    const other = map.map((p) => ({ ...p, extinction: p.extinction * (1 + 1e-5) }));
    expect(sameMap(map, other)).toBe(false);
    expect(sameMap(map, map.slice(1))).toBe(false);
  });

  it("bring their camera, and stay one step of what was there", () => {
    const state = createAppState();
    state.home.value = orbit;
    state.edit.value = startHistory(edit);
    followScene(state, received);
    expect(state.edit.value.present.density).toBe(3);
    expect(state.edit.value.past).toEqual([edit]);
    expect(state.orbit.value?.yaw).toBeCloseTo(0.4, 12);
    expect(state.orbit.value?.pitch).toBeCloseTo(0.9, 12);
  });
});

describe("cameras of the server", () => {
  it("turn about the axis of the data where they stand upright", () => {
    const seen = orbitAbout(cameraMessage(orbit, undefined), [0, 0, 1]);
    expect(seen.axis).toEqual([0, 0, 1]);
    const up = frameOf(dragged(seen, 10, 0, 0.01)).up;
    expect(up[2]).toBeCloseTo(Math.cos(0.9), 9);
  });

  it("keep the roll that a trackball gave them", () => {
    const tilted = rolled(rolled(orbit, 40, 0, 0.02), 0, 30, 0.02);
    const seen = orbitAbout(cameraMessage(tilted, undefined), [0, 0, 1]);
    frameOf(tilted).up.forEach((c, i) => {
      expect(frameOf(seen).up[i]).toBeCloseTo(c, 9);
    });
  });
});
