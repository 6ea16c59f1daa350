import type { AccuracyRow } from "../net/gen/volcast/v1/session_pb";

/** One measured way to draw a layer, as a point of the chart. */
export interface ChartPoint {
  readonly row: AccuracyRow;
  /** Median time of a picture, ms. */
  readonly ms: number;
  /** Root mean square, 1/255; what is drawn, as a logarithm shows no 0. */
  readonly error: number;
}

/** Below this an error is drawn at the bottom, called 0: a hundred thousandth of 1/255. */
export const kFloor = 1e-5;

/** The rows of a layer that could be measured, fastest first. */
export function pointsOf(rows: readonly AccuracyRow[], layer: string): ChartPoint[] {
  return rows
    .filter((row) => row.layer === layer && row.refusal === "" && row.medianMs > 0)
    .map((row) => ({ row, ms: row.medianMs, error: Math.max(kFloor, row.rmsError * 255) }))
    .sort((a, b) => a.ms - b.ms);
}

export interface LogRange {
  readonly low: number;
  readonly high: number;
}

/** A range around `values` > 0 with a little room, at least a factor of 4 wide. */
export function logRange(values: readonly number[]): LogRange {
  const least = Math.min(...values);
  const most = Math.max(...values);
  if (!(least > 0) || !Number.isFinite(most)) return { low: 0.1, high: 10 };
  const room = Math.max(1.4, 2 / Math.sqrt(most / least));
  return { low: least / room, high: most * room };
}

/** Values for a logarithmic axis, about `count` of them: decades, or 1-2-5, or all that are even. */
export function logTicks({ low, high }: LogRange, count: number): number[] {
  const from = Math.floor(Math.log10(low));
  const to = Math.ceil(Math.log10(high));
  const within = (parts: readonly number[], every = 1): number[] => {
    const ticks: number[] = [];
    for (let e = from; e <= to; e += 1) {
      if (e % every !== 0) continue;
      for (const part of parts) ticks.push(Number(`${part}e${e}`));
    }
    return ticks.filter((v) => v >= low && v <= high);
  };
  const all = [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  const choices = [within(all), within([1, 2, 5]), within([1, 3]), within([1])];
  for (const every of [2, 3, 4, 6]) choices.push(within([1], every));
  return choices.find((ticks) => ticks.length <= count) ?? [];
}

/** The index of the place nearest to `at`, of those within `reach`; undefined for none. */
export function nearest(
  places: readonly { left: number; top: number }[],
  at: { left: number; top: number },
  reach: number,
): number | undefined {
  const far = places.map((p) => Math.hypot(p.left - at.left, p.top - at.top));
  const least = Math.min(...far);
  return least <= reach ? far.indexOf(least) : undefined;
}
