import { create, equals } from "@bufbuild/protobuf";
import { Integrator, MeshEvaluator, type Scene, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import type { AccuracyReport, AccuracyRow, EffectTime } from "../net/gen/volcast/v1/session_pb";
import type { Orbit } from "../view/camera";
import { changeLayer } from "./actions";
import type { AppState, Edit, ViewportSize } from "./app_state";

/** A view whose accuracy and cost are or were measured. */
export interface Subject {
  readonly edit: Edit;
  readonly orbit: Orbit | undefined;
  readonly viewport: ViewportSize | undefined;
}

/** What ways to draw a view are worth; the newest measurement, running or ended. */
export interface Measured {
  readonly subject: Subject;
  readonly rows: readonly AccuracyRow[];
  /** Where effects are measured: each by itself, and the picture with all of them, ms. */
  readonly effects: readonly EffectTime[];
  readonly pictureMs: number;
  /** 0 to 1. */
  readonly progress: number;
  readonly running: boolean;
  /** Why it ended before all was measured; empty where it did not. */
  readonly stopped: string;
}

export const subjectOf = (state: AppState): Subject => ({
  edit: state.edit.value.present,
  orbit: state.orbit.value,
  viewport: state.viewport.value,
});

/** Without what is measured: how a layer is drawn, and the wish that chooses it. */
function bare(scene: Scene): Scene {
  const way = { integrator: Integrator.AUTO, evaluator: MeshEvaluator.AUTO };
  const layers = scene.layers.map((layer) => ({ ...layer, ...way }));
  return create(SceneSchema, { ...scene, layers, accuracy: undefined });
}

function sameScene(a: Scene | undefined, b: Scene | undefined): boolean {
  return a === b || (!!a && !!b && equals(SceneSchema, bare(a), bare(b)));
}

/** True while the picture is of the view that was measured, in whatever way it is drawn. */
export function isOfThisView(state: AppState, { subject }: Measured): boolean {
  const now = subjectOf(state);
  const { map, density, smooth, second, scene } = now.edit;
  const then = subject.edit;
  return (
    now.orbit === subject.orbit &&
    now.viewport === subject.viewport &&
    map === then.map &&
    density === then.density &&
    smooth === then.smooth &&
    second === then.second &&
    sameScene(scene, then.scene)
  );
}

const begun = (state: AppState): Measured => ({
  subject: subjectOf(state),
  rows: [],
  effects: [],
  pictureMs: 0,
  progress: 0,
  running: true,
  stopped: "",
});

/** What is measured: ways to draw, what plans know of them, or effects; one at a time. */
export type MeasureAim = "measured" | "estimated" | "effectTimes";

/** What is being measured; undefined: nothing. */
function runningAim({ measured, estimated, effectTimes }: AppState) {
  return [measured, estimated, effectTimes].find((told) => told.value?.running);
}

export const isMeasuring = (state: AppState): boolean => runningAim(state) !== undefined;

export function measuringBegan(state: AppState, aim: MeasureAim = "measured"): void {
  measuringEnded(state, "measured anew");
  state[aim].value = begun(state);
}

export function measuringReported(state: AppState, report: AccuracyReport): void {
  const told = runningAim(state);
  if (!told?.value) return;
  const { rows, effects, pictureMs, progress, done, stopped } = report;
  told.value = { ...told.value, rows, effects, pictureMs, progress, running: !done, stopped };
}

/** Ends what is measured, as nothing more will be heard of it. */
export function measuringEnded(state: AppState, why: string): void {
  const told = runningAim(state);
  if (told?.value) told.value = { ...told.value, running: false, stopped: why };
}

/** True while the picture is the very one that was measured or compared. */
export function isOfThisPicture(
  state: AppState,
  { subject }: { readonly subject: Subject },
): boolean {
  const now = subjectOf(state);
  return (
    now.edit === subject.edit && now.orbit === subject.orbit && now.viewport === subject.viewport
  );
}

/** Draws the first layer in the way that a row says; changes of one `gesture` are one step. */
export function drawBy(state: AppState, row: AccuracyRow, gesture?: string): void {
  changeLayer(state, { integrator: row.integrator, evaluator: row.evaluator }, gesture);
}

/** Leaves the choice to the server again. */
export function drawAutomatically(state: AppState): void {
  changeLayer(state, { integrator: Integrator.AUTO, evaluator: MeshEvaluator.AUTO });
}
