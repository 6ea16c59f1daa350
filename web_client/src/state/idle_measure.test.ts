import { create } from "@bufbuild/protobuf";
import { beforeEach, expect, it } from "vitest";
import { Codec } from "../net/gen/volcast/v1/frame_pb";
import { SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import {
  AccuracyReportSchema,
  PersonSchema,
  WelcomeSchema,
} from "../net/gen/volcast/v1/session_pb";
import { dragged } from "../view/camera";
import { measuringBegan, measuringEnded, measuringReported } from "./accuracy";
import { adoptScene } from "./actions";
import { type AppState, createAppState, type PictureInfo } from "./app_state";
import { followIdle, kIdleMs } from "./idle_measure";
import { kUsualOptions } from "./view_options";

const scene = create(SceneSchema, {
  camera: { eye: { y: -9 }, center: {}, up: { z: 1 }, fovyDegrees: 30 },
  layers: [{ id: "first", dataset: "d" }],
});

let state: AppState;
let timer: { ms: number; run: () => void } | undefined;
let calls: string[];
let end: () => void;

const picture = (inputSeq: bigint, final = true): PictureInfo => ({
  view: 1,
  inputSeq,
  width: 4,
  height: 4,
  codec: Codec.PNG,
  lossless: final,
  final,
  ready: true,
  integrators: [],
  workerGeneration: 1,
  timings: undefined,
  bytes: 9,
  decodeMs: 0,
});

beforeEach(() => {
  state = createAppState();
  adoptScene(state, scene);
  state.connection.value = { kind: "open" };
  state.options.value = { ...kUsualOptions, measureIdle: true };
  state.chartInSight.value = true;
  state.newestInput.value = 3n;
  state.picture.value = picture(3n);
  timer = undefined;
  calls = [];
  end = followIdle(state, {
    measure() {
      calls.push("measure");
      measuringBegan(state);
    },
    stop() {
      calls.push("stop");
      measuringEnded(state, "stopped");
    },
    after(ms, run) {
      const mine = { ms, run };
      timer = mine;
      return () => {
        if (timer === mine) timer = undefined;
      };
    },
  });
});

const rest = (): void => timer?.run();
const finish = (): void =>
  measuringReported(state, create(AccuracyReportSchema, { progress: 1, done: true }));
const turn = (): void => {
  if (state.orbit.value) state.orbit.value = dragged(state.orbit.value, 1, 0, 0.1);
};

it("measures a view that rests, and that one once", () => {
  expect(timer?.ms).toBe(kIdleMs);
  rest();
  expect(calls).toEqual(["measure"]);
  finish();
  expect(timer).toBeUndefined();
  turn();
  expect(timer).toBeDefined();
});

it("waits anew after every change, and not before the exact picture", () => {
  const before = timer;
  turn();
  expect(timer).toBeDefined();
  expect(timer).not.toBe(before);
  state.newestInput.value = 4n;
  expect(timer).toBeUndefined();
  state.picture.value = picture(4n, false);
  expect(timer).toBeUndefined();
  state.picture.value = picture(4n);
  expect(timer).toBeDefined();
});

it("does nothing unasked, out of sight, while something else is done, for watchers, or after its end", () => {
  state.options.value = kUsualOptions;
  expect(timer).toBeUndefined();
  state.options.value = { ...kUsualOptions, measureIdle: true };
  expect(timer).toBeDefined();
  state.chartInSight.value = false;
  expect(timer).toBeUndefined();
  state.chartInSight.value = true;
  state.playing.value = { ...state.playing.value, on: true };
  expect(timer).toBeUndefined();
  state.playing.value = { ...state.playing.value, on: false };
  measuringBegan(state, "effectTimes");
  expect(timer).toBeUndefined();
  measuringEnded(state, "over");
  expect(timer).toBeDefined();
  state.welcome.value = create(WelcomeSchema, { person: 2 });
  state.people.value = [
    create(PersonSchema, { id: 1, steers: true }),
    create(PersonSchema, { id: 2 }),
  ];
  expect(timer).toBeUndefined();
  state.people.value = [];
  expect(timer).toBeDefined();
  end();
  expect(timer).toBeUndefined();
});

it("stops what it began when it is out of sight, and begins again when it is back", () => {
  rest();
  state.chartInSight.value = false;
  expect(calls).toEqual(["measure", "stop"]);
  state.chartInSight.value = true;
  rest();
  expect(calls).toEqual(["measure", "stop", "measure"]);
});

it("leaves what a person began, and does not begin again what a person stopped", () => {
  measuringBegan(state);
  state.chartInSight.value = false;
  expect(calls).toEqual([]);
  state.chartInSight.value = true;
  measuringEnded(state, "stopped by the client");
  expect(timer).toBeUndefined();
});
