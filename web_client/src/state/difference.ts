import type { DifferenceReport } from "../net/gen/volcast/v1/session_pb";
import { readHalves } from "../net/halves";
import { isMeasuring, isOfThisPicture, type Subject, subjectOf } from "./accuracy";
import type { AppState } from "./app_state";

/** How far the picture is from the reference; the newest comparison, running or ended. */
export interface Difference {
  readonly subject: Subject;
  /** Of the picture; 0 before the first report. */
  readonly width: number;
  readonly height: number;
  /** By pixel of the picture, 1 is white; NaN where nothing is known. Filled in place. */
  readonly off: Float32Array;
  /** The finest grid so far: a pixel stands for a square of that many. */
  readonly step: number;
  readonly figures: Figures | undefined;
  /** 0 to 1. */
  readonly progress: number;
  readonly running: boolean;
  /** Why it ended before all was compared; empty where it did not. */
  readonly stopped: string;
}

/** Over all pixels that were compared; errors with 1 as white. */
export interface Figures {
  readonly pixels: number;
  readonly max: number;
  readonly rms: number;
  /** Of pixels off by more than 1/255. */
  readonly shareOver255: number;
}

/** What the server says of a comparison that something else was measured in the place of. */
export const kReplaced = "measured anew";

/** Writes a part into `off`, each value over the square that it stands for until finer ones come. */
export function fillPart(off: Float32Array, report: DifferenceReport): void {
  const { width, height, step, refines, firstRow } = report;
  const values = readHalves(report.off);
  let at = 0;
  for (let y = Math.ceil(firstRow / step) * step; y < height && at < values.length; y += step) {
    const coarse = refines && y % (2 * step) === 0;
    for (let x = coarse ? step : 0; x < width; x += coarse ? 2 * step : step) {
      const value = values[at] ?? Number.NaN;
      at += 1;
      for (let row = y; row < Math.min(y + step, height); row += 1) {
        off.fill(value, row * width + x, row * width + Math.min(x + step, width));
      }
    }
  }
}

export function comparingBegan(state: AppState): void {
  state.difference.value = {
    subject: subjectOf(state),
    width: 0,
    height: 0,
    off: new Float32Array(0),
    step: 0,
    figures: undefined,
    progress: 0,
    running: true,
    stopped: "",
  };
}

export function comparisonReported(state: AppState, report: DifferenceReport): void {
  const before = state.difference.value;
  if (!before?.running) return;
  const { width, height, done, stopped, progress } = report;
  const first = before.width !== width || before.height !== height;
  const off = first ? new Float32Array(width * height).fill(Number.NaN) : before.off;
  if (report.off.length > 0) fillPart(off, report);
  const figures = {
    pixels: Number(report.pixels),
    max: report.maxError,
    rms: report.rmsError,
    shareOver255: report.shareOver255,
  };
  state.difference.value = {
    subject: before.subject,
    width,
    height,
    off,
    step: report.off.length > 0 ? report.step : before.step,
    figures: figures.pixels > 0 ? figures : undefined,
    progress,
    running: !done,
    stopped,
  };
}

/** Ends a comparison of which nothing more will be heard. */
export function comparisonEnded(state: AppState, why: string): void {
  const { value } = state.difference;
  if (value?.running) state.difference.value = { ...value, running: false, stopped: why };
}

/** The picture on the screen is exact, of the newest input, and not compared, or not to the end. */
export function needsComparison(state: AppState): boolean {
  const picture = state.picture.value;
  const difference = state.difference.value;
  const { newestInput } = state;
  if (!state.comparing.value || state.connection.value.kind !== "open") return false;
  if (!picture?.final || picture.inputSeq < newestInput.value) return false;
  if (isMeasuring(state)) return false;
  if (!difference || !isOfThisPicture(state, difference)) return true;
  return !difference.running && difference.stopped === kReplaced;
}
