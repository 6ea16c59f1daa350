import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { changeDensity, changeEdit, redo } from "./actions";
import { createAppState } from "./app_state";
import { isRefused, sentenceOf, takeBack } from "./refusal";

describe("a refusal", () => {
  it("is a sentence that names the setting as the panel does", () => {
    const said = (field: string, why: string): string =>
      sentenceOf({ field, message: `${field}: ${why}` });
    expect(said("layers[0].levels.values", "an isosurface needs at least one level")).toBe(
      "Levels: an isosurface needs at least one level.",
    );
    expect(said("layers[0].levels", "layers[0].levels.values: is empty")).toBe("Levels: is empty.");
    expect(said("accuracy.bound", "0.000000 is not above 0")).toBe("Accuracy: 0 is not above 0.");
    expect(said("layers[0].density_scale.domain", "1.500000 to -2.000000 is no range.")).toBe(
      "Domain of the second field's scale: 1.5 to -2 is no range.",
    );
    expect(said("layers[0].extinction_scale", "10.050000 is odd")).toBe("Strength: 10.05 is odd.");
    expect(said("layers[0].scale.exponent", "-1 is not above 0")).toMatch(/^Exponent of the scale/);
    expect(
      sentenceOf({ field: "layers[0].shader.code", message: "layers[0].shader.code:\nline 2: no" }),
    ).toBe("Shader: line 2: no.");
  });

  it("is told without a name where there is none", () => {
    expect(sentenceOf({ field: "", message: "no such view" })).toBe("no such view.");
    expect(sentenceOf({ field: "what.ever", message: "" })).toBe(
      "what.ever: the server refused this.",
    );
  });

  it("marks the settings at its path and no others", () => {
    const state = createAppState();
    expect(isRefused(state, "levels")).toBe(false);
    const field = "layers[0].density_scale.domain";
    state.refusal.value = { inputSeq: 1n, field, message: "" };
    expect(isRefused(state, "density_scale")).toBe(true);
    expect(isRefused(state, "density_scale.domain")).toBe(true);
    expect(isRefused(state, "density_scale.exponent")).toBe(false);
    expect(isRefused(state, "scale")).toBe(false);
  });

  it("is taken back to what is drawn, and can be tried again", () => {
    const state = createAppState();
    changeDensity(state, 2);
    const accepted = state.edit.value.present;
    changeDensity(state, 3);
    state.refusal.value = { inputSeq: 1n, field: "x", message: "" };
    takeBack(state, accepted);
    expect(state.edit.value.present).toBe(accepted);
    expect(state.edit.value.past).toHaveLength(1);
    expect(state.refusal.value).toBeUndefined();
    redo(state);
    expect(state.edit.value.present.density).toBe(3);
  });

  it("that is taken back leaves refused code in the editor", () => {
    const state = createAppState();
    const sceneWith = (code: string) => create(SceneSchema, { layers: [{ shader: { code } }] });
    changeEdit(state, { scene: sceneWith("good") });
    const accepted = state.edit.value.present;
    changeEdit(state, { scene: sceneWith("bad") });
    takeBack(state, accepted);
    expect(state.layer.value?.shader?.code).toBe("good");
    expect(state.codeDraft.value).toBe("bad");
  });
});
