import { create } from "@bufbuild/protobuf";
import { beforeEach, describe, expect, it } from "vitest";
import { Integrator, MeshEvaluator, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { AccuracyReportSchema, AccuracyRowSchema } from "../net/gen/volcast/v1/session_pb";
import { dragged } from "../view/camera";
import {
  drawAutomatically,
  drawBy,
  isMeasuring,
  isOfThisView,
  measuringBegan,
  measuringEnded,
  measuringReported,
} from "./accuracy";
import { adoptScene, changeLayer, changeScene, undo } from "./actions";
import { type AppState, createAppState } from "./app_state";

const scene = create(SceneSchema, {
  camera: { eye: { y: -9 }, center: {}, up: { z: 1 }, fovyDegrees: 30 },
  layers: [{ id: "first", dataset: "d" }],
});
const row = create(AccuracyRowSchema, {
  layer: "first",
  integrator: Integrator.PSI,
  evaluator: MeshEvaluator.WALK,
});

let state: AppState;
beforeEach(() => {
  state = createAppState();
  adoptScene(state, scene);
  measuringBegan(state);
});

const isCurrent = (): boolean => {
  const { value } = state.measured;
  return value !== undefined && isOfThisView(state, value);
};

describe("a measurement", () => {
  it("takes reports until it is done", () => {
    measuringReported(state, create(AccuracyReportSchema, { progress: 0.5, rows: [row] }));
    expect(state.measured.value).toMatchObject({ running: true, progress: 0.5 });
    measuringReported(state, create(AccuracyReportSchema, { progress: 1, done: true }));
    expect(state.measured.value).toMatchObject({ running: false, progress: 1, stopped: "" });
    measuringReported(state, create(AccuracyReportSchema, { progress: 0 }));
    expect(state.measured.value?.progress).toBe(1);
  });

  it("keeps its rows and says why when it ends early", () => {
    measuringReported(state, create(AccuracyReportSchema, { progress: 0.5, rows: [row] }));
    measuringEnded(state, "the connection was lost");
    expect(state.measured.value).toMatchObject({ running: false, rows: [row] });
    expect(state.measured.value?.stopped).toBe("the connection was lost");
    measuringEnded(state, "something else");
    expect(state.measured.value?.stopped).toBe("the connection was lost");
  });

  it("is of the view for as long as only the way to draw it changes", () => {
    expect(isCurrent()).toBe(true);
    drawBy(state, row);
    expect(state.layer.value).toMatchObject({ integrator: row.integrator, evaluator: 1 });
    expect(isCurrent()).toBe(true);
    changeLayer(state, { hidden: true });
    expect(isCurrent()).toBe(false);
    undo(state);
    expect(isCurrent()).toBe(true);
    drawAutomatically(state);
    expect(state.layer.value).toMatchObject({ integrator: 0, evaluator: 0 });
    changeScene(state, { background: { $typeName: "volcast.v1.Colour", r: 1, g: 1, b: 1 } });
    expect(isCurrent()).toBe(false);
  });

  it("is not of the view once the camera turned", () => {
    if (state.orbit.value) state.orbit.value = dragged(state.orbit.value, 1, 0, 0.1);
    expect(isCurrent()).toBe(false);
  });
});

describe("what is measured", () => {
  it("is one thing at a time, each kept where it belongs", () => {
    measuringBegan(state, "effectTimes");
    expect(state.measured.value?.running).toBe(false);
    const effects = [{ layer: "first", effect: "light", ms: 2.5, refusal: "" }];
    measuringReported(
      state,
      create(AccuracyReportSchema, { progress: 1, done: true, effects, pictureMs: 12 }),
    );
    expect(state.effectTimes.value).toMatchObject({ running: false, pictureMs: 12, effects });
    expect(state.measured.value?.effects).toEqual([]);
    expect(isMeasuring(state)).toBe(false);
  });
});
