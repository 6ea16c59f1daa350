import type { Sample } from "../state/samples";
import { formatBytes, formatMs, formatNumber } from "./format";

/** Times on performance.now()'s clock in ms, ascending, with a value each. */
export type Series = readonly (readonly [at: number, value: number])[];

export interface HudRow {
  readonly name: string;
  readonly series: Series;
  readonly text: (value: number) => string;
}

export const kWindowMs = 20_000;
const kBinMs = 500;

/** A value of each sample of the window that has it. */
function of(samples: readonly Sample[], value: (s: Sample) => number | undefined): Series {
  return samples.flatMap((s) => {
    const v = value(s);
    return v === undefined ? [] : [[s.at, v] as const];
  });
}

/** Sums a second, by half seconds up to `now`. */
export function perSecond(
  samples: readonly Sample[],
  now: number,
  value: (s: Sample) => number,
): Series {
  const bins = kWindowMs / kBinMs;
  const sums = new Array<number>(bins).fill(0);
  const start = now - kWindowMs;
  for (const s of samples) {
    const bin = Math.floor((s.at - start) / kBinMs);
    if (bin >= 0 && bin < bins) sums[bin] = (sums[bin] ?? 0) + value(s);
  }
  return sums.map((sum, i) => [start + (i + 1) * kBinMs, (sum * 1000) / kBinMs] as const);
}

const plain = (v: number): string => formatNumber(v, 3);

/** The charts of the last 20 s, from top to bottom; what the server does not tell is left out. */
export function hudRows(all: readonly Sample[], now: number): HudRow[] {
  const samples = all.filter((s) => now - s.at <= kWindowMs);
  const rows: HudRow[] = [
    { name: "Input to drawn", series: of(samples, (s) => s.latency), text: formatMs },
    { name: "Render", series: of(samples, (s) => s.render || undefined), text: formatMs },
    { name: "Encode", series: of(samples, (s) => s.encode), text: formatMs },
    { name: "Network and rest", series: of(samples, (s) => s.network), text: formatMs },
    { name: "Decode", series: of(samples, (s) => s.decode), text: formatMs },
    { name: "Frames/s", series: perSecond(samples, now, () => 1), text: plain },
    {
      name: "Bytes/s",
      series: perSecond(samples, now, (s) => s.bytes),
      text: (v) => formatBytes(Math.round(v)),
    },
    { name: "Quality", series: of(samples, (s) => s.quality), text: plain },
    { name: "Under way", series: of(samples, (s) => s.credits?.[0]), text: plain },
  ];
  const optional = new Set(["Quality", "Under way"]);
  return rows.filter((row) => row.series.length > 0 || !optional.has(row.name));
}

/** Points of an SVG line, 100 wide and 20 high, from 0 to the largest value. */
export function lineOf(series: Series, now: number): string {
  const most = Math.max(...series.map(([, v]) => v), 1e-9);
  return series
    .map(([at, v]) => {
      const x = 100 * (1 - (now - at) / kWindowMs);
      return `${x.toFixed(2)},${(19 - (18 * v) / most).toFixed(2)}`;
    })
    .join(" ");
}
