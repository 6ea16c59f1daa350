import { create } from "@bufbuild/protobuf";
import { Integrator, RayModel } from "../net/gen/volcast/v1/scene_pb";
import { type AccuracyRow, AccuracyRowSchema } from "../net/gen/volcast/v1/session_pb";
import { isOfThisView } from "./accuracy";
import { isMesh } from "./actions";
import type { AppState } from "./app_state";
import { factsOf, kIntegratorNames, voxelIntegratorsOf } from "./models";

/** One way to draw, as a stop of the slider from fastest to exact. */
export interface Stop {
  readonly row: AccuracyRow;
  /** Of one picture; undefined where nobody knows. */
  readonly ms: number | undefined;
  /** Largest, in 1/255 of white; undefined where nobody knows. */
  readonly error: number | undefined;
}

/** Where a stop's figures come from; "order": there are none, only what costs more than what. */
export type Source = "measured" | "estimated" | "order";

export interface Stops {
  readonly source: Source;
  /** Fastest first, each more accurate than those before it. */
  readonly stops: readonly Stop[];
}

const stopOf = (row: AccuracyRow): Stop => ({
  row,
  ms: row.medianMs > 0 ? row.medianMs : undefined,
  error: 255 * row.maxError,
});

/** The front of what was measured. */
export function measuredStops(rows: readonly AccuracyRow[], layer: string): Stop[] {
  return rows
    .filter((row) => row.layer === layer && row.onFront && row.refusal === "" && row.medianMs > 0)
    .map(stopOf)
    .sort((a, b) => (a.ms ?? 0) - (b.ms ?? 0));
}

/** Of estimates, from cheap to exact where times are not known, those that no cheaper one beats. */
export function estimatedStops(rows: readonly AccuracyRow[], layer: string): Stop[] {
  const stops = rows.filter((row) => row.layer === layer).map(stopOf);
  if (stops.every(({ ms }) => ms !== undefined)) stops.sort((a, b) => (a.ms ?? 0) - (b.ms ?? 0));
  let least = Number.POSITIVE_INFINITY;
  return stops.filter(({ error = 0 }) => {
    const better = error < least;
    least = Math.min(least, error);
    return better;
  });
}

/**
 * Estimates of voxels come from small pictures: they tell what one way takes beside another. Where the picture on the
 * screen is one layer drawn in one of these ways, what it took tells the rest.
 */
function asDrawn(state: AppState, rows: readonly AccuracyRow[]): readonly AccuracyRow[] {
  const picture = state.picture.value;
  const drawn = rows.find(
    (row) => picture?.final && kIntegratorNames[row.integrator] === picture.integrators[0],
  );
  const tookMs = picture?.timings?.drawMs ?? 0;
  if (!drawn || picture?.integrators.length !== 1 || drawn.medianMs <= 0 || tookMs <= 0)
    return rows;
  const scale = tookMs / drawn.medianMs;
  return rows.map((row) => ({ ...row, medianMs: scale * row.medianMs }));
}

/** The integrators of a model by their order alone. */
export function plainStops(integrators: readonly Integrator[]): Stop[] {
  return integrators.map((integrator) => ({
    row: create(AccuracyRowSchema, { integrator }),
    ms: undefined,
    error: undefined,
  }));
}

function integratorsHere(state: AppState): readonly Integrator[] {
  const model = state.layer.value?.model || RayModel.VOLUME;
  return isMesh(state) ? factsOf(model).integrators : voxelIntegratorsOf(model);
}

/** What the slider offers for the first layer, by the best that is known of this view. */
export function stopsOf(state: AppState): Stops {
  const layer = state.layer.value?.id ?? "";
  const { measured, estimated } = state;
  if (measured.value && isOfThisView(state, measured.value)) {
    const stops = measuredStops(measured.value.rows, layer);
    if (stops.length > 0) return { source: "measured", stops };
  }
  if (estimated.value && isOfThisView(state, estimated.value)) {
    const { rows } = estimated.value;
    const stops = estimatedStops(isMesh(state) ? rows : asDrawn(state, rows), layer);
    if (stops.length > 0) return { source: "estimated", stops };
  }
  return { source: "order", stops: plainStops(integratorsHere(state)) };
}

/** False where the first layer can be drawn in one way alone. */
export const hasChoice = (state: AppState): boolean =>
  integratorsHere(state).length > 1 || stopsOf(state).stops.length > 1;

/** The stop by which the first layer is drawn; undefined where it is drawn in another way. */
export function usedStop(state: AppState, stops: readonly Stop[]): number | undefined {
  const layer = state.layer.value;
  if (!layer) return undefined;
  const found = stops.findIndex(({ row }) => {
    if (layer.integrator === Integrator.AUTO) {
      return kIntegratorNames[row.integrator] === state.picture.value?.integrators[0];
    }
    return row.integrator === layer.integrator && row.evaluator === layer.evaluator;
  });
  return found < 0 ? undefined : found;
}
