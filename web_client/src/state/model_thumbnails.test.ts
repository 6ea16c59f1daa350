import { create } from "@bufbuild/protobuf";
import { beforeEach, describe, expect, it } from "vitest";
import { Integrator, RayModel, type Scene, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { DatasetInfoSchema } from "../net/gen/volcast/v1/session_pb";
import { dragged } from "../view/camera";
import { adoptScene, changeLayer } from "./actions";
import { type AppState, createAppState } from "./app_state";
import { chooseModel } from "./layer_actions";
import { sceneOfModel, ThumbnailKeeper, thumbnailSize } from "./model_thumbnails";
import { sceneMessage } from "./scene_message";

let state: AppState;
beforeEach(() => {
  state = createAppState();
  state.datasets.value = [
    create(DatasetInfoSchema, { id: "d", fields: [{ name: "f", min: 2, max: 4, steps: 1 }] }),
  ];
  const camera = { eye: { y: -9 }, center: {}, up: { z: 1 }, fovyDegrees: 30 };
  const layers = [{ id: "a", dataset: "d", field: "f", integrator: Integrator.PSI }];
  adoptScene(state, create(SceneSchema, { camera, layers }));
});

describe("the scene of a model's thumbnail", () => {
  it("is what choosing the model shows", () => {
    for (const model of [RayModel.ISOSURFACE, RayModel.MIP, RayModel.VOLUME]) {
      const thumbnail = sceneOfModel(state, model);
      chooseModel(state, model);
      const { scene, orbit, bounds, edit } = state;
      if (!scene.value || !orbit.value) throw new Error("there is no scene");
      const shown = sceneMessage(scene.value, orbit.value, bounds.value, edit.value.present);
      expect(thumbnail).toEqual(shown);
    }
  });

  it("has a level to show and runs no code", () => {
    changeLayer(state, { shader: { $typeName: "volcast.v1.UserShader", code: "x", controls: [] } });
    expect(sceneOfModel(state, RayModel.ISOSURFACE)?.layers[0]?.levels?.values).toEqual([3]);
    expect(sceneOfModel(state, RayModel.VOLUME)?.layers[0]?.shader).toBeUndefined();
  });
});

describe("a thumbnail's size", () => {
  it("is in device pixels, up to what the server draws", () => {
    expect(thumbnailSize(1)).toEqual({ width: 96, height: 72 });
    expect(thumbnailSize(2)).toEqual({ width: 192, height: 144 });
    expect(thumbnailSize(4)).toEqual({ width: 256, height: 192 });
  });
});

describe("the keeper of thumbnails", () => {
  const asked: { request: number; scene: Scene }[] = [];
  let keeper: ThumbnailKeeper;
  beforeEach(() => {
    asked.length = 0;
    keeper = new ThumbnailKeeper(state, (request, scene) => asked.push({ request, scene }) > 0);
    state.pictured.value = [RayModel.MIP, RayModel.XRAY];
  });
  const models = () => asked.map(({ scene }) => scene.layers[0]?.model);
  const answer = (refusal = "") => {
    const request = asked[asked.length - 1]?.request ?? 0;
    return keeper.answered({ request, picture: Uint8Array.of(1, 2), refusal });
  };

  it("asks for one after the other, and for none twice", () => {
    keeper.advance();
    keeper.advance();
    expect(models()).toEqual([RayModel.MIP]);
    expect(answer()).toBe(true);
    keeper.advance();
    expect(models()).toEqual([RayModel.MIP, RayModel.XRAY]);
    answer("no memory");
    keeper.advance();
    expect(asked.length).toBe(2);
    expect(state.thumbnails.value.get(RayModel.MIP)?.picture?.size).toBe(2);
    expect(state.thumbnails.value.get(RayModel.XRAY)).toEqual({
      picture: undefined,
      refusal: "no memory",
    });
  });

  it("asks again when the camera moved, but not when another model was chosen", () => {
    for (let i = 0; i < 2; i += 1) {
      keeper.advance();
      answer();
    }
    chooseModel(state, RayModel.MIP);
    keeper.advance();
    expect(asked.length).toBe(2);
    if (state.orbit.value) state.orbit.value = dragged(state.orbit.value, 9, 0, 0.01);
    keeper.advance();
    expect(models()).toEqual([RayModel.MIP, RayModel.XRAY, RayModel.MIP]);
  });

  it("takes no late answer for a newer one, and asks again after a loss", () => {
    keeper.advance();
    expect(keeper.answered({ request: 99, picture: new Uint8Array(), refusal: "" })).toBe(false);
    keeper.lost();
    keeper.advance();
    expect(models()).toEqual([RayModel.MIP, RayModel.MIP]);
  });
});
