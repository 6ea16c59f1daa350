import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { CameraSchema, LayerSchema, RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { bothOf } from "../transfer/apart";
import { readScene, writeScene } from "./scene_text";

const scene = create(SceneSchema, {
  camera: create(CameraSchema, { eye: { x: 1.5, y: 0, z: 1e-30 }, fovyDegrees: 35 }),
  layers: [create(LayerSchema, { id: "a", dataset: "d.vtu", model: RayModel.MIP })],
});

const colour = { r: 0.25, g: 0, b: 1 };
const map = [0, 1, 2, 3, 7].map((value, i) => ({ value, colour, extinction: (i * i) % 5 }));
const edit = {
  map,
  density: 2.5,
  smooth: 0.25,
  apart: { ...bothOf(map), knots: [0, 0.5, 2] },
  second: { map, density: 1, smooth: undefined, apart: undefined },
};

describe("saved scenes", () => {
  it("of scripts have nothing of an editor", () => {
    const { editor, ...rest } = JSON.parse(writeScene(scene, edit));
    expect(editor.density).toBe(2.5);
    expect(readScene(JSON.stringify(rest))).toEqual({ scene, edit: undefined });
  });

  it("are what they were, in the names that the server reads", () => {
    const text = writeScene(scene, edit);
    expect(readScene(text)).toEqual({ scene, edit });
    expect(text).toContain('"model": "RAY_MODEL_MIP"');
    expect(text.endsWith("}\n")).toBe(true);
  });

  it("are refused with the reason", () => {
    expect(() => readScene("{")).toThrow();
    expect(() => readScene("[]")).toThrow();
    const odd = writeScene(scene, { ...edit, density: -1 });
    expect(() => readScene(odd)).toThrow("editor.density is not above 0");
    expect(() => readScene('{"layerz": []}')).toThrow(/layerz/);
    expect(() => readScene('{"layers": [{"model": "RAY_MODEL_GUESS"}]}')).toThrow(
      /RAY_MODEL_GUESS/,
    );
    expect(() => readScene("{}")).toThrow("it has no layers");
    expect(() => readScene('{"layers": [{"id": "a"}]}')).toThrow("it has no camera");
  });
});
