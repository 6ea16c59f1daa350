import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import {
  DatasetInfoSchema,
  DatasetKind,
  DatasetState,
  WelcomeSchema,
} from "../net/gen/volcast/v1/session_pb";
import { dragged } from "../view/camera";
import {
  adoptScene,
  changeDensity,
  changeLayer,
  changeMap,
  changeScene,
  currentDocument,
  modelsOf,
  redo,
  refitCamera,
  resetCamera,
  restoreDocument,
  undo,
} from "./actions";
import { createAppState } from "./app_state";
import { changeField, chooseModel } from "./layer_actions";

const dataset = create(DatasetInfoSchema, {
  id: "d",
  state: DatasetState.READY,
  kind: DatasetKind.MESH,
  boundsMin: { x: 0, y: 0, z: 0 },
  boundsMax: { x: 3, y: 4, z: 12 },
  fields: [
    { name: "a", min: 0, max: 10 },
    { name: "b", min: -1, max: 1 },
  ],
});
const point = (value: number, extinction: number) => ({
  value,
  colour: { r: 1, g: 1, b: 1 },
  extinction,
});
const scene = create(SceneSchema, {
  camera: {
    eye: { x: 1.5, y: -30, z: 6 },
    center: { x: 1.5, y: 2, z: 6 },
    up: { z: 1 },
    fovyDegrees: 30,
  },
  layers: [
    {
      id: "l",
      dataset: "d",
      field: "a",
      model: RayModel.VOLUME,
      transferFunction: { points: [point(0, 0), point(5, 1), point(10, 2)] },
    },
  ],
});

function opened(width = 800, height = 600) {
  const state = createAppState();
  state.datasets.value = [dataset];
  state.viewport.value = { width, height };
  adoptScene(state, scene);
  return state;
}

describe("a scene that the server made", () => {
  it("is shown as it came, unless the picture is too narrow for it", () => {
    const wide = opened();
    expect(wide.orbit.value).toBe(wide.home.value);
    const narrow = opened(300, 600);
    expect(narrow.orbit.value?.distance).toBeGreaterThan(narrow.home.value?.distance ?? 0);
    expect(wide.referenceLength.value).toBeCloseTo(1.3, 12);
  });

  it("goes on being shown whole in another viewport, until the camera is moved", () => {
    const state = opened(300, 600);
    state.viewport.value = { width: 800, height: 600 };
    refitCamera(state);
    expect(state.orbit.value).toBe(state.home.value);
    const moved = state.orbit.value && dragged(state.orbit.value, 10, 0, 0.01);
    state.orbit.value = moved;
    state.viewport.value = { width: 300, height: 600 };
    refitCamera(state);
    expect(state.orbit.value).toBe(moved);
    resetCamera(state);
    expect(state.orbit.value).not.toBe(moved);
  });
});

describe("fields", () => {
  it("get the map over their own range, and keep theirs", () => {
    const state = opened();
    changeDensity(state, 0.5);
    changeField(state, "b");
    expect(state.edit.value.present.map.map((p) => p.value)).toEqual([-1, 0, 1]);
    changeMap(state, [point(-1, 3), point(1, 3)]);
    changeField(state, "a");
    expect(state.edit.value.present.map.map((p) => p.value)).toEqual([0, 5, 10]);
    changeField(state, "b");
    expect(state.edit.value.present.map).toHaveLength(2);
    changeField(state, "no such field");
    expect(state.layer.value?.field).toBe("b");
  });
});

describe("models", () => {
  it("are those of the shown kind of data", () => {
    const state = opened();
    state.welcome.value = create(WelcomeSchema, {
      meshModels: [RayModel.SURFACE],
      volumeModels: [RayModel.MIP],
    });
    expect(modelsOf(state)).toEqual([RayModel.SURFACE]);
    state.datasets.value = [{ ...dataset, kind: DatasetKind.VOLUME }];
    expect(modelsOf(state)).toEqual([RayModel.MIP]);
  });
});

describe("undo", () => {
  it("goes back over every setting, and never over the camera", () => {
    const state = opened();
    const before = state.edit.value.present;
    chooseModel(state, RayModel.XRAY);
    changeLayer(state, { extinctionScale: 2 });
    changeScene(state, { clipPlanes: [] });
    const orbit = state.orbit.value && dragged(state.orbit.value, 10, 0, 0.01);
    state.orbit.value = orbit;
    undo(state);
    undo(state);
    expect(state.layer.value?.model).toBe(RayModel.XRAY);
    expect(state.layer.value?.extinctionScale).toBeUndefined();
    undo(state);
    expect(state.edit.value.present).toBe(before);
    expect(state.orbit.value).toBe(orbit);
    redo(state);
    expect(state.layer.value?.model).toBe(RayModel.XRAY);
    expect(scene.layers[0]?.model).toBe(RayModel.VOLUME);
  });

  it("takes all of a drag for one step", () => {
    const state = opened();
    for (const exposure of [1, 2, 3]) changeLayer(state, { exposure }, "Exposure");
    undo(state);
    expect(state.layer.value?.exposure).toBe(0);
  });
});

describe("a document", () => {
  it("brings everything back", () => {
    const state = opened();
    changeDensity(state, 2);
    const document = currentDocument(state);
    changeDensity(state, 3);
    changeLayer(state, { model: RayModel.MIP });
    if (document) restoreDocument(state, document);
    expect(state.edit.value.present.density).toBe(2);
    expect(state.layer.value?.model).toBe(RayModel.VOLUME);
    undo(state);
    expect(state.edit.value.present.density).toBe(2);
  });

  it("leaves out what the server refused", () => {
    const state = opened();
    state.accepted.value = state.edit.value.present;
    changeLayer(state, { exposure: 1000 });
    state.refusal.value = { inputSeq: 2n, field: "layers[0].exposure", message: "too much" };
    expect(currentDocument(state)?.scene.layers[0]?.exposure).toBe(0);
    state.refusal.value = undefined;
    expect(currentDocument(state)?.scene.layers[0]?.exposure).toBe(1000);
  });
});
