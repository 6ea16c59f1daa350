import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { DatasetInfoSchema, DatasetKind, DatasetState } from "../net/gen/volcast/v1/session_pb";
import { adoptScene, changeLayer, undo } from "./actions";
import { createAppState } from "./app_state";
import { drawTogether } from "./channel_actions";
import {
  canBeLit,
  canBeSliced,
  changeLight,
  changeSection,
  changeSeed,
  chooseStep,
  lightNumbers,
  moveLight,
  placeLight,
  sectionsOf,
  stepKindOf,
  switchJitter,
  switchLight,
} from "./voxel_actions";

function opened() {
  const state = createAppState();
  const dataset = create(DatasetInfoSchema, {
    id: "v",
    state: DatasetState.READY,
    kind: DatasetKind.VOLUME,
    boundsMin: { x: 0, y: -1, z: 0 },
    boundsMax: { x: 4, y: 1, z: 10 },
    voxels: [5, 3, 101],
    fields: [
      { name: "a", max: 1 },
      { name: "b", max: 1 },
    ],
  });
  state.datasets.value = [dataset];
  const layers = [{ id: "l", dataset: dataset.id, field: "a" }];
  adoptScene(state, create(SceneSchema, { layers }));
  const layer = () => {
    if (!state.layer.value) throw new Error("there is no layer");
    return state.layer.value;
  };
  return { state, layer };
}

describe("light", () => {
  it("is switched on as the server would, changed, and switched off", () => {
    const { state, layer } = opened();
    switchLight(state, true);
    changeLight(state, { ambient: 0.5 });
    const { light } = layer();
    expect(light && lightNumbers(light)).toEqual({
      ambient: 0.5,
      diffuse: 0.7,
      specular: 0.2,
      exponent: 32,
    });
    switchLight(state, false);
    expect(layer().light).toBeUndefined();
  });

  it("comes from the eye, or from a point that can be moved", () => {
    const { state, layer } = opened();
    switchLight(state, true);
    expect(layer().light?.position).toBeUndefined();
    placeLight(state, "point");
    expect(layer().light?.position).toMatchObject({ x: 6, y: 2, z: 15 });
    moveLight(state, 1, -7);
    expect(layer().light?.position).toMatchObject({ x: 6, y: -7, z: 15 });
    placeLight(state, "eye");
    expect(layer().light?.position).toBeUndefined();
  });

  it("is offered where the server takes it", () => {
    const { state, layer } = opened();
    expect(canBeLit(layer())).toBe(true);
    switchLight(state, true);
    drawTogether(state, true);
    expect(canBeLit(layer())).toBe(false);
    expect(layer().light).toBeUndefined();
    drawTogether(state, false);
    changeLayer(state, { model: RayModel.MIP });
    expect(canBeLit(layer())).toBe(false);
  });
});

describe("cross-sections", () => {
  it("meet in the middle until one is moved", () => {
    const { state, layer } = opened();
    const bounds = state.bounds.value;
    if (!bounds) throw new Error("there are no bounds");
    expect(sectionsOf(layer().crossSections, bounds)).toEqual({
      point: [2, 0, 5],
      shown: [true, true, true],
    });
    changeSection(state, 1, { shown: false });
    expect(layer().crossSections?.point).toBeUndefined();
    changeSection(state, 2, { position: 8 });
    expect(sectionsOf(layer().crossSections, bounds)).toEqual({
      point: [2, 0, 8],
      shown: [true, false, true],
    });
    undo(state);
    expect(sectionsOf(layer().crossSections, bounds).point).toEqual([2, 0, 5]);
  });
});

describe("the distance of samples", () => {
  it("is the server's, a length or a count", () => {
    const { state, layer } = opened();
    expect(stepKindOf(layer())).toBe("usual");
    chooseStep(state, "length");
    expect(layer()).toMatchObject({ depthSamples: 0 });
    expect(layer().stepWorld).toBeCloseTo(0.05, 12);
    expect(stepKindOf(layer())).toBe("length");
    chooseStep(state, "count");
    expect(layer()).toMatchObject({ depthSamples: 64, stepWorld: 0 });
    chooseStep(state, "usual");
    expect(layer()).toMatchObject({ depthSamples: 0, stepWorld: 0 });
  });
});

describe("sampling", () => {
  it("is jittered by a seed, or not at all", () => {
    const { state, layer } = opened();
    switchJitter(state, true);
    expect(layer().jitter).toBe(1);
    changeSeed(state, 7.4);
    expect(layer().jitter).toBe(7);
    changeSeed(state, -3);
    expect(layer().jitter).toBe(0);
    switchJitter(state, false);
    expect(layer().jitter).toBeUndefined();
  });

  it("can be by slices where rays gather one channel by its map", () => {
    const { state, layer } = opened();
    expect(canBeSliced(layer())).toBe(true);
    changeLayer(state, { model: RayModel.CROSS_SECTIONS });
    expect(canBeSliced(layer())).toBe(false);
  });
});
