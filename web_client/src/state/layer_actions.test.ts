import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import {
  Integrator,
  MeshEvaluator,
  RayModel,
  Scale_Kind,
  SceneSchema,
} from "../net/gen/volcast/v1/scene_pb";
import {
  Association,
  DatasetInfoSchema,
  DatasetKind,
  DatasetState,
} from "../net/gen/volcast/v1/session_pb";
import { adoptScene, axisOfSlot, changeLayer, changeMap, undo } from "./actions";
import { createAppState } from "./app_state";
import {
  changeField,
  changeInterval,
  changeMarkers,
  chooseModel,
  chooseScale,
  chooseSecondField,
  markerFields,
} from "./layer_actions";
import { sceneMessage } from "./scene_message";

const point = (value: number) => ({ value, colour: { r: 1, g: 1, b: 1 }, extinction: 1 });
const dataset = create(DatasetInfoSchema, {
  id: "layer actions",
  state: DatasetState.READY,
  kind: DatasetKind.MESH,
  boundsMax: { x: 1, y: 1, z: 1 },
  fields: [
    { name: "a", min: -10, max: 10 },
    { name: "b", min: 1, max: 3 },
    { name: "part", min: 2, max: 5, association: Association.CELL },
  ],
});

function opened() {
  const state = createAppState();
  state.datasets.value = [dataset];
  const transferFunction = { points: [point(-10), point(0), point(10)] };
  const layers = [{ id: "l", dataset: dataset.id, field: "a", transferFunction }];
  adoptScene(state, create(SceneSchema, { layers }));
  return state;
}

const values = (state: ReturnType<typeof opened>): number[] =>
  state.edit.value.present.map.map((p) => p.value);

describe("a ray model", () => {
  it("comes with what it needs, and leaves what cannot serve it, in one step", () => {
    const state = opened();
    const before = state.edit.value.present;
    changeLayer(state, { integrator: Integrator.PSI, evaluator: MeshEvaluator.WALK });
    chooseModel(state, RayModel.ISOSURFACE);
    expect(state.layer.value).toMatchObject({
      model: RayModel.ISOSURFACE,
      integrator: Integrator.AUTO,
      evaluator: MeshEvaluator.WALK,
    });
    expect(state.layer.value?.levels?.values).toEqual([0]);
    undo(state);
    undo(state);
    expect(state.edit.value.present).toBe(before);
  });
});

describe("another field", () => {
  it("takes the levels along and leaves interval and scale behind", () => {
    const state = opened();
    chooseModel(state, RayModel.ISOSURFACE);
    changeInterval(state, { min: 1, max: 2 });
    chooseScale(state, "first", Scale_Kind.POWER);
    changeField(state, "b");
    expect(state.layer.value?.levels?.values).toEqual([2]);
    expect(state.layer.value?.interval).toBeUndefined();
    expect(state.layer.value?.scale).toBeUndefined();
    changeField(state, "a");
    expect(state.layer.value?.scale?.kind).toBe(Scale_Kind.POWER);
    undo(state);
    expect(state.layer.value?.field).toBe("b");
  });
});

describe("a second field", () => {
  it("gets a map over its own range, which is sent with it", () => {
    const state = opened();
    const { scene } = state.edit.value.present;
    chooseSecondField(state, "b");
    const { map } = state.edit.value.present.second ?? { map: [] };
    expect([map[0]?.value, map[map.length - 1]?.value]).toEqual([1, 3]);
    changeMap(state, [point(1), point(2)], undefined, "second");
    expect(state.edit.value.present.second?.map).toHaveLength(2);
    expect(values(state)).toEqual([-10, 0, 10]);
    const { present } = state.edit.value;
    const orbit = state.orbit.value;
    if (present.scene && orbit) {
      const sent = sceneMessage(present.scene, orbit, undefined, present);
      expect(sent.layers[0]?.densityFunction?.points).toHaveLength(2);
    }
    chooseSecondField(state, "");
    expect(state.layer.value?.densityField).toBe("");
    expect(state.edit.value.present.second).toBeUndefined();
    undo(state);
    undo(state);
    undo(state);
    expect(state.edit.value.present.scene).toBe(scene);
  });
});

describe("a logarithmic scale", () => {
  it("moves map, levels and interval to where logarithms are, and back, in one step each", () => {
    const state = opened();
    const before = state.edit.value.present;
    chooseModel(state, RayModel.ISOSURFACE);
    changeInterval(state, { min: -1, max: 2 });
    chooseScale(state, "first", Scale_Kind.LOG);
    expect(values(state)[0]).toBeCloseTo(0.01, 12);
    expect(values(state)[2]).toBeCloseTo(10, 12);
    expect(state.layer.value?.interval).toBeUndefined();
    expect(state.layer.value?.levels?.values[0]).toBeGreaterThan(0);
    expect(axisOfSlot(state).low).toBeCloseTo(0.01, 12);
    chooseScale(state, "first", Scale_Kind.LINEAR);
    expect(values(state)).toEqual([-10, 0, 10]);
    for (let i = 0; i < 4; i += 1) undo(state);
    expect(state.edit.value.present).toBe(before);
  });

  it("leaves a map of positive values where it is", () => {
    const state = opened();
    changeField(state, "b");
    const { map } = state.edit.value.present;
    chooseScale(state, "first", Scale_Kind.LOG);
    expect(state.edit.value.present.map).toBe(map);
    expect(state.layer.value?.scale?.domain).toBeUndefined();
  });
});

describe("cells", () => {
  it("are chosen by the fields that they have", () => {
    const state = opened();
    expect(markerFields(state).map((f) => f.name)).toEqual(["part"]);
    changeMarkers(state, "part", [2, 4]);
    expect(state.layer.value?.markers).toMatchObject({ field: "part", values: [2, 4] });
    changeMarkers(state, "", []);
    expect(state.layer.value?.markers).toBeUndefined();
  });
});
