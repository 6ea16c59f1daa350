import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { CameraSchema, LayerSchema, RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { readScene, writeScene } from "./scene_text";

const scene = create(SceneSchema, {
  camera: create(CameraSchema, { eye: { x: 1.5, y: 0, z: 1e-30 }, fovyDegrees: 35 }),
  layers: [create(LayerSchema, { id: "a", dataset: "d.vtu", model: RayModel.MIP })],
});

describe("saved scenes", () => {
  it("are what they were, in the names that the server reads", () => {
    const text = writeScene(scene);
    expect(readScene(text)).toEqual(scene);
    expect(text).toContain('"model": "RAY_MODEL_MIP"');
    expect(text.endsWith("}\n")).toBe(true);
  });

  it("are refused with the reason", () => {
    expect(() => readScene("{")).toThrow();
    expect(() => readScene('{"layerz": []}')).toThrow(/layerz/);
    expect(() => readScene('{"layers": [{"model": "RAY_MODEL_GUESS"}]}')).toThrow(
      /RAY_MODEL_GUESS/,
    );
    expect(() => readScene("{}")).toThrow("it has no layers");
    expect(() => readScene('{"layers": [{"id": "a"}]}')).toThrow("it has no camera");
  });
});
