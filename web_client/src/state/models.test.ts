import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { Integrator, LayerSchema, MeshEvaluator, RayModel } from "../net/gen/volcast/v1/scene_pb";
import {
  evaluatorsOf,
  factsOf,
  fittedTo,
  usesColours,
  usesExtinction,
  voxelIntegratorsOf,
} from "./models";

const kModels = Object.values(RayModel).filter(
  (m): m is RayModel => typeof m === "number" && m !== RayModel.UNSPECIFIED,
);

describe("ray models", () => {
  it("all have a name of their own, a meaning, and end with the exact integrator", () => {
    const facts = kModels.map(factsOf);
    expect(kModels).toHaveLength(10);
    expect(new Set(facts.map((f) => f.name)).size).toBe(kModels.length);
    for (const { meaning, integrators } of facts) {
      expect(meaning).toMatch(/^[A-Z].*\.$/);
      expect(integrators[integrators.length - 1]).toBe(Integrator.EXACT);
    }
  });

  it("of a newer server are shown by number and drawn as they come", () => {
    expect(factsOf(77 as RayModel).name).toBe("Model 77");
  });

  it("say what of the map they use", () => {
    const uses = (model: RayModel, more = {}) => {
      const layer = create(LayerSchema, { model, ...more });
      return [usesColours(layer), usesExtinction(layer)];
    };
    expect(uses(RayModel.VOLUME)).toEqual([true, true]);
    expect(uses(RayModel.UNSPECIFIED)).toEqual([true, true]);
    expect(uses(RayModel.VOLUME, { shader: { code: "void main() {}" } })).toEqual([false, false]);
    expect(uses(RayModel.MIP)).toEqual([true, false]);
    expect(uses(RayModel.SPLAT)).toEqual([true, false]);
    expect(uses(RayModel.XRAY)).toEqual([false, true]);
    expect(uses(RayModel.CROSS_SECTIONS)).toEqual([true, false]);
    expect(uses(RayModel.WIREFRAME)).toEqual([false, false]);
    expect(uses(RayModel.SURFACE, { coloured: true })).toEqual([true, false]);
  });

  it("leave to the second field's map what it gives", () => {
    const parts = (model: RayModel) => {
      const layer = create(LayerSchema, { model, densityField: "g" });
      const of = (slot: "first" | "second") => [
        usesColours(layer, slot),
        usesExtinction(layer, slot),
      ];
      return [of("first"), of("second")];
    };
    expect(parts(RayModel.VOLUME)).toEqual([
      [true, false],
      [false, true],
    ]);
    expect(parts(RayModel.XRAY)).toEqual([
      [false, false],
      [false, true],
    ]);
    expect(parts(RayModel.ISOSURFACE)).toEqual([
      [false, false],
      [true, false],
    ]);
    expect(parts(RayModel.MIP)).toEqual([
      [true, false],
      [false, false],
    ]);
  });
});

describe("choices by name", () => {
  it("of voxels are those that the server has for them", () => {
    expect(voxelIntegratorsOf(RayModel.VOLUME)).not.toContain(Integrator.PSI_TABLE);
    expect(voxelIntegratorsOf(RayModel.VOLUME)).toContain(Integrator.ADAPTIVE);
    expect(voxelIntegratorsOf(RayModel.XRAY)).toContain(Integrator.ADAPTIVE);
    expect(voxelIntegratorsOf(RayModel.MIP_COLOUR)).toEqual([Integrator.ENDS, Integrator.EXACT]);
    expect(voxelIntegratorsOf(RayModel.MIP)).toEqual([]);
  });

  it("stay with a model that they serve, and go back to automatic with others", () => {
    const layer = create(LayerSchema, {
      model: RayModel.XRAY,
      integrator: Integrator.ENDS,
      evaluator: MeshEvaluator.PROJECTION,
    });
    expect(fittedTo(layer, RayModel.SPLAT)).toMatchObject({
      integrator: Integrator.ENDS,
      evaluator: MeshEvaluator.PROJECTION,
    });
    expect(fittedTo(layer, RayModel.VOLUME).integrator).toBe(Integrator.AUTO);
    expect(fittedTo(layer, RayModel.SURFACE)).toEqual({
      model: RayModel.SURFACE,
      integrator: Integrator.AUTO,
      evaluator: MeshEvaluator.AUTO,
      channels: [],
      shader: undefined,
    });
  });

  it("offer all faces only where extremes of both ends are enough", () => {
    const faces = (model: RayModel, integrator = Integrator.AUTO): boolean =>
      evaluatorsOf(model, integrator).includes(MeshEvaluator.PROJECTION_FACES);
    expect(faces(RayModel.MIP)).toBe(true);
    expect(faces(RayModel.MIP_COLOUR, Integrator.ENDS)).toBe(true);
    expect(faces(RayModel.MIP_COLOUR, Integrator.EXACT)).toBe(false);
    expect(faces(RayModel.VOLUME)).toBe(false);
    expect(evaluatorsOf(RayModel.SURFACE, Integrator.AUTO)).toEqual([MeshEvaluator.AUTO]);
  });
});
