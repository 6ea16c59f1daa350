import { create } from "@bufbuild/protobuf";
import { beforeEach, describe, expect, it } from "vitest";
import { SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { DatasetInfoSchema } from "../net/gen/volcast/v1/session_pb";
import { adoptScene, undo } from "./actions";
import { type AppState, createAppState, type PictureInfo } from "./app_state";
import { followTime, nextStep, showStep, togglePlaying } from "./time_steps";

const scene = create(SceneSchema, {
  camera: { eye: { y: -9 }, center: {}, up: { z: 1 }, fovyDegrees: 30 },
  layers: [{ id: "a", dataset: "d", field: "f" }],
});

/** Time that passes only when it is told to. */
class Hands {
  time = 0;
  readonly #timers: { at: number; run: () => void }[] = [];
  now(): number {
    return this.time;
  }
  after(ms: number, run: () => void): void {
    this.#timers.push({ at: this.time + ms, run });
  }
  pass(ms: number): void {
    this.time += ms;
    for (const timer of this.#timers.splice(0)) {
      if (timer.at <= this.time) timer.run();
      else this.#timers.push(timer);
    }
  }
}

let state: AppState;
let hands: Hands;
beforeEach(() => {
  state = createAppState();
  hands = new Hands();
  state.datasets.value = [
    create(DatasetInfoSchema, { id: "d", fields: [{ name: "f", max: 1, steps: 3 }] }),
  ];
  adoptScene(state, scene);
  state.connection.value = { kind: "open" };
  followTime(state, hands);
});

const step = (): number => state.layer.value?.timeStep ?? -1;
/** The server draws what was sent. */
function drawn(): void {
  state.newestInput.value += 1n;
  state.picture.value = { inputSeq: state.newestInput.value } as PictureInfo;
}
/** It was sent and is not drawn yet. */
function sent(): void {
  state.newestInput.value += 1n;
}

describe("time steps", () => {
  it("end with the last, or go round", () => {
    expect([0, 1, 2].map((s) => nextStep(s, 3, false))).toEqual([1, 2, undefined]);
    expect(nextStep(2, 3, true)).toBe(0);
    expect(nextStep(0, 1, true)).toBeUndefined();
  });

  it("stay within what the field has and are undone together", () => {
    showStep(state, 1);
    showStep(state, 99);
    expect(step()).toBe(2);
    undo(state);
    expect(step()).toBe(0);
  });

  it("follow each other at their speed once they are drawn, and wait for the server", () => {
    drawn();
    togglePlaying(state);
    hands.pass(0);
    expect(step()).toBe(1);
    sent();
    hands.pass(1000);
    expect(step()).toBe(1);
    drawn();
    hands.pass(0);
    expect(step()).toBe(2);
    drawn();
    hands.pass(199);
    expect(step()).toBe(2);
    hands.pass(1);
    expect(step()).toBe(0);
  });

  it("stop behind the last where they do not go round, and begin again at the first", () => {
    state.playing.value = { on: false, speed: 1000, loop: false };
    drawn();
    togglePlaying(state);
    for (let i = 0; i < 4; i += 1) {
      hands.pass(1);
      drawn();
    }
    hands.pass(1);
    expect(state.playing.value.on).toBe(false);
    expect(step()).toBe(2);
    togglePlaying(state);
    expect(step()).toBe(0);
  });

  it("stop at a field that has one step", () => {
    state.datasets.value = [
      create(DatasetInfoSchema, { id: "d", fields: [{ name: "f", max: 1, steps: 1 }] }),
    ];
    drawn();
    togglePlaying(state);
    expect(state.playing.value.on).toBe(false);
  });
});
