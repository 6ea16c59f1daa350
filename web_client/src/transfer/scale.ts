import { type Scale, Scale_Kind } from "../net/gen/volcast/v1/scene_pb";

/** Where a value lies on an axis; monotone. */
export type Along = (value: number) => number;

/** A scale and its inverse; both monotone between `low` and `high`, the ends of its domain. */
export interface Axis {
  readonly along: Along;
  readonly back: (place: number) => number;
  readonly low: number;
  readonly high: number;
}

export const kStraight: Axis = {
  along: (v) => v,
  back: (p) => p,
  low: Number.NEGATIVE_INFINITY,
  high: Number.POSITIVE_INFINITY,
};

const clamp = (x: number, low: number, high: number): number => Math.min(high, Math.max(low, x));

/** The axis of a field of this range; straight where the scale has no meaning over it. */
export function axisOf(scale: Scale | undefined, min: number, max: number): Axis {
  const low = scale?.domain?.min ?? min;
  const high = scale?.domain?.max ?? max;
  if (!scale || !(high > low)) return kStraight;
  if (scale.kind === Scale_Kind.LOG && low > 0) {
    return { along: (v) => Math.log(clamp(v, low, high)), back: Math.exp, low, high };
  }
  const exponent = scale.exponent || 1;
  if (scale.kind === Scale_Kind.POWER && exponent > 0) {
    const span = high - low;
    return {
      along: (v) => (clamp(v - low, 0, span) / span) ** exponent,
      back: (p) => low + span * clamp(p, 0, 1) ** (1 / exponent),
      low,
      high,
    };
  }
  return kStraight;
}

/** The part of a field's range that a logarithm can show: three powers of ten below its top. */
export function positiveDomain(min: number, max: number): { min: number; max: number } | undefined {
  if (min > 0 || !(max > 0)) return undefined;
  return { min: max / 1000, max };
}
