import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { TimingsSchema } from "../net/gen/volcast/v1/frame_pb";
import { Integrator, MeshEvaluator, RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import {
  AccuracyReportSchema,
  type AccuracyRow,
  AccuracyRowSchema,
  DatasetInfoSchema,
  DatasetKind,
} from "../net/gen/volcast/v1/session_pb";
import { dragged } from "../view/camera";
import { drawBy, measuringBegan, measuringReported } from "./accuracy";
import { estimatedStops, hasChoice, measuredStops, stopsOf, usedStop } from "./accuracy_stops";
import { adoptScene } from "./actions";
import { createAppState, type PictureInfo } from "./app_state";
import { kIntegratorNames } from "./models";

const row = (part: Partial<AccuracyRow>): AccuracyRow =>
  Object.assign(create(AccuracyRowSchema, { layer: "a" }), part);

describe("measured stops", () => {
  it("are the front of the layer, fastest first, errors in 1/255", () => {
    const rows = [
      row({ medianMs: 9, onFront: true, maxError: 0 }),
      row({ medianMs: 5, onFront: false, maxError: 0.5 }),
      row({ medianMs: 3, onFront: true, maxError: 2 / 255 }),
      row({ medianMs: 1, onFront: true, maxError: 1, refusal: "no room" }),
      row({ medianMs: 1, onFront: true, layer: "b" }),
    ];
    const stops = measuredStops(rows, "a");
    expect(stops.map((s) => s.ms)).toEqual([3, 9]);
    expect(stops[0]?.error).toBeCloseTo(2, 9);
  });
});

describe("estimated stops", () => {
  it("leave out what a faster one beats", () => {
    const rows = [
      row({ medianMs: 4, maxError: 0.1 }),
      row({ medianMs: 6, maxError: 0.2 }),
      row({ medianMs: 2, maxError: 0.3 }),
      row({ medianMs: 8, maxError: 0 }),
    ];
    expect(estimatedStops(rows, "a").map((s) => s.ms)).toEqual([2, 4, 8]);
  });

  it("keep the order of the server where times are not known", () => {
    const rows = [row({ maxError: 0.3 }), row({ maxError: 0.4 }), row({ maxError: 0.1 })];
    const stops = estimatedStops(rows, "a");
    expect(stops.map((s) => s.error)).toEqual([255 * 0.3, 255 * 0.1]);
    expect(stops[0]?.ms).toBeUndefined();
  });
});

describe("the slider's stops", () => {
  const open = (model = RayModel.XRAY) => {
    const state = createAppState();
    state.datasets.value = [create(DatasetInfoSchema, { id: "d", kind: DatasetKind.MESH })];
    const layers = [{ id: "a", dataset: "d", model }];
    const camera = { eye: { y: -9 }, center: {}, up: { z: 1 }, fovyDegrees: 30 };
    adoptScene(state, create(SceneSchema, { camera, layers }));
    return state;
  };
  const done = (rows: AccuracyRow[], estimated = false) =>
    create(AccuracyReportSchema, { done: true, progress: 1, rows, estimated });

  it("are the model's own until something is known, then estimates, then what was measured", () => {
    const state = open();
    expect(stopsOf(state).source).toBe("order");
    expect(stopsOf(state).stops.map((s) => s.row.integrator)).toEqual([
      Integrator.FRONT,
      Integrator.ENDS,
      Integrator.EXACT,
    ]);
    measuringBegan(state, "estimated");
    measuringReported(state, done([row({ integrator: Integrator.EXACT, medianMs: 7 })], true));
    expect(stopsOf(state)).toMatchObject({ source: "estimated", stops: [{ ms: 7 }] });
    measuringBegan(state);
    measuringReported(state, done([row({ medianMs: 3, onFront: true })]));
    expect(stopsOf(state)).toMatchObject({ source: "measured", stops: [{ ms: 3 }] });
    if (state.orbit.value) state.orbit.value = dragged(state.orbit.value, 9, 0, 0.01);
    expect(stopsOf(state).source).toBe("order");
  });

  it("are offered where a model has several ways, be one of them the best in all", () => {
    const state = open();
    expect(hasChoice(state)).toBe(true);
    measuringBegan(state, "estimated");
    measuringReported(state, done([row({ integrator: Integrator.EXACT, medianMs: 7 })], true));
    expect(stopsOf(state).stops.length).toBe(1);
    expect(hasChoice(state)).toBe(true);
    const single = open(RayModel.SURFACE);
    expect(stopsOf(single).stops.length).toBe(1);
    expect(hasChoice(single)).toBe(false);
    measuringBegan(single);
    measuringReported(single, done([row({ medianMs: 3, onFront: true })]));
    expect(stopsOf(single).source).toBe("measured");
    expect(hasChoice(single)).toBe(false);
  });

  it("of voxels take as long as the picture says, each beside the way that drew it", () => {
    const state = open();
    state.datasets.value = [create(DatasetInfoSchema, { id: "d", kind: DatasetKind.VOLUME })];
    measuringBegan(state, "estimated");
    const rows = [
      row({ integrator: Integrator.FRONT, medianMs: 2, maxError: 0.5 }),
      row({ integrator: Integrator.ENDS, medianMs: 3, maxError: 0.1 }),
    ];
    measuringReported(state, done(rows, true));
    const times = () => stopsOf(state).stops.map(({ ms }) => ms);
    expect(times()).toEqual([2, 3]);
    const timings = create(TimingsSchema, { drawMs: 40 });
    const integrators = [kIntegratorNames[Integrator.FRONT]];
    const picture = { final: true, integrators, timings } as unknown as PictureInfo;
    state.picture.value = picture;
    expect(times()).toEqual([40, 60]);
    // Moving pictures may be smaller, and of several layers none is known.
    state.picture.value = { ...picture, final: false };
    expect(times()).toEqual([2, 3]);
    state.picture.value = { ...picture, integrators: [...picture.integrators, "psi"] };
    expect(times()).toEqual([2, 3]);
  });

  it("say which one draws the picture, be it by name or as the wish asks", () => {
    const state = open();
    measuringBegan(state);
    const rough = row({ integrator: Integrator.FRONT, evaluator: 2, medianMs: 3, onFront: true });
    const exact = row({ integrator: Integrator.EXACT, medianMs: 5, onFront: true });
    measuringReported(state, done([rough, exact]));
    const used = () => usedStop(state, stopsOf(state).stops);
    expect(used()).toBeUndefined();
    drawBy(state, rough, "accuracy");
    expect(used()).toBe(0);
    expect(state.layer.value?.evaluator).toBe(MeshEvaluator.PROJECTION);
    drawBy(state, exact, "accuracy");
    expect(used()).toBe(1);
    expect(state.edit.value.past.length).toBe(1);
  });
});
