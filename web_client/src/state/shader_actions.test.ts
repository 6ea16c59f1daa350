import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import {
  DatasetInfoSchema,
  DatasetKind,
  DatasetState,
  type ShaderControl,
  ShaderControlSchema,
  ShaderDescriptionSchema,
} from "../net/gen/volcast/v1/session_pb";
import { adoptScene, undo } from "./actions";
import { createAppState } from "./app_state";
import { drawTogether } from "./channel_actions";
import { chooseModel } from "./layer_actions";
import {
  applyCode,
  changeControl,
  codeToDescribe,
  complaintsOf,
  controlsOf,
  controlValue,
  removeCode,
  shownCode,
  takeDescription,
} from "./shader_actions";
import { switchLight } from "./voxel_actions";

const kCode = "void main() {}";
const slider = (max = 2): ShaderControl =>
  create(ShaderControlSchema, {
    name: "s",
    kind: { case: "slider", value: { type: "float", min: 0, max, initial: 1 } },
  });

function opened() {
  const state = createAppState();
  const dataset = create(DatasetInfoSchema, {
    id: "v",
    state: DatasetState.READY,
    kind: DatasetKind.VOLUME,
    fields: [
      { name: "a", max: 1 },
      { name: "b", max: 1 },
    ],
  });
  state.datasets.value = [dataset];
  const layers = [{ id: "l", dataset: dataset.id, field: "a", model: RayModel.VOLUME }];
  adoptScene(state, create(SceneSchema, { layers }));
  const type = (code: string): void => {
    state.codeDraft.value = code;
  };
  const answer = (controls: ShaderControl[] = [], complaints: string[] = []): void => {
    const asked = codeToDescribe(state);
    if (!asked) throw new Error("nothing is asked");
    const lines = complaints.map((message) => ({ line: 3, column: 1, message }));
    const description = create(ShaderDescriptionSchema, { controls, complaints: lines });
    takeDescription(state, { ...asked, ...description });
  };
  const shader = () => state.layer.value?.shader;
  return { state, type, answer, shader };
}

describe("code", () => {
  it("is described when it is applied, and drawn when nothing is wrong with it", () => {
    const { state, type, answer, shader } = opened();
    switchLight(state, true);
    type(kCode);
    expect(codeToDescribe(state)).toBeUndefined();
    applyCode(state);
    expect(codeToDescribe(state)).toEqual({ code: kCode, dataset: "v" });
    expect(shader()).toBeUndefined();
    answer([slider()]);
    expect(shader()?.code).toBe(kCode);
    expect(state.layer.value?.light).toBeUndefined();
    expect(controlsOf(state).map((c) => c.name)).toEqual(["s"]);
    expect(codeToDescribe(state)).toBeUndefined();
    undo(state);
    expect(shader()).toBeUndefined();
  });

  it("with complaints stays in the editor, with its lines", () => {
    const { state, type, answer, shader } = opened();
    type("void");
    applyCode(state);
    answer([], ["there is no main"]);
    expect(shader()).toBeUndefined();
    expect(shownCode(state)).toBe("void");
    expect(complaintsOf(state)).toMatchObject([{ line: 3, message: "there is no main" }]);
    type("void ");
    expect(complaintsOf(state)).toEqual([]);
    type("void");
    applyCode(state);
    expect(codeToDescribe(state)).toBeUndefined();
    expect(shader()).toBeUndefined();
  });

  it("that is wrong leaves the code that is drawn with its controls", () => {
    const { state, type, answer, shader } = opened();
    type(kCode);
    applyCode(state);
    answer([slider()]);
    type("void");
    applyCode(state);
    answer([], ["there is no main"]);
    expect(shader()?.code).toBe(kCode);
    expect(codeToDescribe(state)).toBeUndefined();
    expect(complaintsOf(state).length).toBe(1);
    expect(controlsOf(state).length).toBe(1);
  });

  it("is kept in the editor when the map, another model or channels are drawn", () => {
    const leaving = [
      removeCode,
      (state: ReturnType<typeof createAppState>) => chooseModel(state, RayModel.XRAY),
      (state: ReturnType<typeof createAppState>) => drawTogether(state, true),
    ];
    for (const leave of leaving) {
      const { state, type, answer, shader } = opened();
      type(kCode);
      applyCode(state);
      answer();
      leave(state);
      expect(shader()).toBeUndefined();
      expect(shownCode(state)).toBe(kCode);
    }
  });

  it("that is empty draws the map", () => {
    const { state, type, answer, shader } = opened();
    type(kCode);
    applyCode(state);
    answer();
    type(" \n");
    applyCode(state);
    expect(shader()).toBeUndefined();
    expect(shownCode(state)).toBe("");
  });
});

describe("controls", () => {
  it("are at their default until they are set, which asks nothing of the server", () => {
    const { state, type, answer, shader } = opened();
    type(kCode);
    applyCode(state);
    const control = slider();
    answer([control]);
    expect(controlValue(state, control)).toEqual({ case: "number", value: 1 });
    changeControl(state, "s", { case: "number", value: 0.5 });
    changeControl(state, "s", { case: "number", value: 1.5 });
    expect(controlValue(state, control)).toEqual({ case: "number", value: 1.5 });
    expect(shader()?.controls.length).toBe(1);
    expect(codeToDescribe(state)).toBeUndefined();
  });

  it("keep their state under new code that can still take it", () => {
    const { state, type, answer, shader } = opened();
    const apply = (code: string, control: ShaderControl): void => {
      type(code);
      applyCode(state);
      answer([control]);
    };
    apply("a", slider());
    changeControl(state, "s", { case: "number", value: 1.5 });
    apply("b", slider(1.75));
    expect(shader()?.controls.length).toBe(1);
    apply("c", slider(1.25));
    expect(shader()).toMatchObject({ code: "c", controls: [] });
  });
});
