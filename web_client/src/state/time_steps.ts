import { effect, untracked } from "@preact/signals";
import { changeLayer, endGesture } from "./actions";
import type { AppState } from "./app_state";
import { whyNotSteering } from "./people";

/** How time steps follow each other by themselves. */
export interface Playing {
  readonly on: boolean;
  /** Steps a second at most: each waits for the picture of the one before. */
  readonly speed: number;
  /** Begins again behind the last step. */
  readonly loop: boolean;
}

export const kUsualPlaying: Playing = { on: false, speed: 5, loop: true };
export const kSpeeds: readonly number[] = [1, 2, 5, 10, 25];

export const stepsOf = (state: AppState): number => state.field.value?.steps ?? 1;

/** The step behind `step` of `count`; undefined behind the last one, unless it goes round. */
export function nextStep(step: number, count: number, loop: boolean): number | undefined {
  if (count < 2) return undefined;
  if (step + 1 < count) return step + 1;
  return loop ? 0 : undefined;
}

const kGesture = "time step";

/** Shows another step; all that are passed until `endGesture` are undone together. */
export function showStep(state: AppState, step: number): void {
  const last = stepsOf(state) - 1;
  const timeStep = Math.min(last, Math.max(0, Math.round(step)));
  if (timeStep !== state.layer.value?.timeStep) changeLayer(state, { timeStep }, kGesture);
}

/** Starts, from the first step where the last is shown, or stops. */
export function togglePlaying(state: AppState): void {
  const { on, loop } = state.playing.value;
  state.playing.value = { ...state.playing.value, on: !on };
  if (on) {
    endGesture(state);
    return;
  }
  const shown = state.layer.value?.timeStep ?? 0;
  if (nextStep(shown, stepsOf(state), loop) === undefined) showStep(state, 0);
}

/** What a player needs of the world around it. */
export interface Clock {
  now(): number;
  after(ms: number, run: () => void): void;
}

/**
 * While it plays: shows the next step once the picture of this one is there, be that late, but not
 * before its time. Returns its end.
 */
export function followTime(state: AppState, clock: Clock): () => void {
  let shownAt = Number.NEGATIVE_INFINITY;
  /** Timers of what was planned before do nothing. */
  let plan = 0;
  /** The step that each input shows, of those whose picture may still come. */
  const sent = new Map<bigint, number>();
  const current = (): number => state.layer.value?.timeStep ?? 0;
  const advance = (): void => {
    const next = nextStep(current(), stepsOf(state), state.playing.value.loop);
    if (next === undefined) togglePlaying(state);
    else {
      shownAt = clock.now();
      showStep(state, next);
    }
  };
  const endNoting = effect(() => {
    const inputSeq = state.newestInput.value;
    sent.set(inputSeq, untracked(current));
  });
  const endPlaying = effect(() => {
    const { on, speed } = state.playing.value;
    const shown = state.picture.value?.inputSeq ?? -1n;
    for (const seq of sent.keys()) if (seq < shown) sent.delete(seq);
    const isThere = sent.get(shown) === current();
    const count = stepsOf(state);
    plan += 1;
    if (!on || !isThere || state.connection.value.kind !== "open") return;
    if (count < 2 || whyNotSteering(state) !== undefined) {
      untracked(() => togglePlaying(state));
      return;
    }
    const mine = plan;
    clock.after(Math.max(0, shownAt + 1000 / speed - clock.now()), () => {
      if (mine === plan) advance();
    });
  });
  return () => {
    endNoting();
    endPlaying();
  };
}
