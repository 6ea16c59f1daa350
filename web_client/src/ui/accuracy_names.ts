import { MeshEvaluator } from "../net/gen/volcast/v1/scene_pb";
import type { AccuracyRow } from "../net/gen/volcast/v1/session_pb";
import { kIntegratorLabels } from "../state/models";
import { formatMs, formatNumber } from "./format";

const kEvaluators: Readonly<Record<MeshEvaluator, string>> = {
  [MeshEvaluator.AUTO]: "",
  [MeshEvaluator.WALK]: "walk",
  [MeshEvaluator.PROJECTION]: "projection",
  [MeshEvaluator.PROJECTION_FACES]: "all faces",
};

export const evaluatorName = (row: AccuracyRow): string => kEvaluators[row.evaluator];

/** "Psi, closed form · walk". */
export function wayOf(row: AccuracyRow): string {
  return [kIntegratorLabels[row.integrator], evaluatorName(row)].filter(Boolean).join(" · ");
}

/** An error, given with 1 as the display's white, in 1/255. */
export function errorText(error: number): string {
  const steps = error * 255;
  return steps === 0 ? "0" : formatNumber(steps, 2);
}

/** "12 ms, error 0.3 rms, 2.1 at most (1/255)". */
export function worthOf(row: AccuracyRow): string {
  if (row.refusal) return row.refusal;
  const error = `${errorText(row.rmsError)} rms, ${errorText(row.maxError)} at most (1/255)`;
  return `${formatMs(row.medianMs)}, error ${error}`;
}
