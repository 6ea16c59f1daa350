import type { Axis } from "../transfer/scale";

/** A value of a legend; `place` from 0 at its low end to 1. */
export interface Tick {
  readonly value: number;
  readonly place: number;
}

const kMost = 6;
/** Closer to an end than this, a value is not shown: the end is. */
const kRoom = 0.09;

/** Multiples of a round step between two values; about `count` of them. */
function roundValues(low: number, high: number, count: number): number[] {
  const rough = (high - low) / count;
  const size = 10 ** Math.floor(Math.log10(rough));
  const step = size * ([1, 2, 5].find((s) => s * size >= rough) ?? 10);
  const values: number[] = [];
  for (let i = Math.ceil(low / step); i * step <= high; i += 1) {
    values.push(Number((i * step).toPrecision(12)));
  }
  return values;
}

/** Powers of ten between two values > 0. */
function powers(low: number, high: number): number[] {
  const values: number[] = [];
  for (let e = Math.ceil(Math.log10(low)); e <= Math.log10(high); e += 1) values.push(10 ** e);
  return values;
}

/** Both ends and round values between them, as they lie on the field's axis. */
export function legendTicks(axis: Axis, low: number, high: number): Tick[] {
  const from = axis.along(low);
  const span = axis.along(high) - from;
  if (!(span > 0)) return [{ value: low, place: 0 }];
  const middle = axis.back(from + span / 2);
  const isLog = low > 0 && high / low >= 100 && middle < (low + high) / 4;
  const inner = isLog ? powers(low, high) : roundValues(low, high, 4);
  const ticks = inner
    .map((value) => ({ value, place: (axis.along(value) - from) / span }))
    .filter(({ place }) => place > kRoom && place < 1 - kRoom);
  const every = Math.ceil(ticks.length / kMost);
  const kept = ticks.filter((_, i) => i % every === 0);
  return [{ value: low, place: 0 }, ...kept, { value: high, place: 1 }];
}
