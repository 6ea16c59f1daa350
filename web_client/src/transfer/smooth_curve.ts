import type { Apart } from "./apart";
import { depthOf, resolved } from "./drawn_map";
import { opacityFromExtinction } from "./opacity";
import type { OpacityPoint } from "./opacity_curve";
import type { Axis } from "./scale";
import { type Spline, withoutIdleKnots, withoutPointOf, withPointOn } from "./spline";
import { type Point, type TransferFunction, withoutIdlePoints } from "./transfer_function";

/** The opacities of a map that follow a spline, and what they are over. */
export interface SmoothCurve {
  readonly opacities: TransferFunction;
  readonly knots?: readonly number[] | undefined;
  /** That opacities are over, in world units. */
  readonly distance: number;
  readonly axis: Axis;
}

const firstOf = (map: TransferFunction): number => map[0]?.value ?? 0;
const lastOf = (map: TransferFunction): number => map[map.length - 1]?.value ?? 0;

/** Where a value lies between two others, along an axis. */
function placeOf(value: number, first: number, last: number, { along }: Axis): number {
  if (value === first || value === last) return value === first ? 0 : 1;
  return (along(value) - along(first)) / (along(last) - along(first));
}

function placed(
  { opacities, distance, axis }: SmoothCurve,
  first: number,
  last: number,
): OpacityPoint[] {
  return opacities.map(({ value, extinction }) => ({
    position: placeOf(value, first, last, axis),
    opacity: opacityFromExtinction(extinction, distance),
  }));
}

/** What `change` makes of a curve's points; those that it leaves alone are the very same. */
function changedBy<Result extends { readonly spline: Spline }>(
  curve: SmoothCurve,
  change: (spline: Spline) => Result,
): Result & { opacities: TransferFunction; knots: readonly number[] | undefined } {
  const { opacities, knots, distance, axis } = curve;
  const [first, last] = [firstOf(opacities), lastOf(opacities)];
  const points = placed(curve, first, last);
  const result = change({ points, knots });
  const start = axis.along(first);
  const span = axis.along(last) - start;
  const next = result.spline.points.map((point): Point => {
    const same = opacities[points.indexOf(point)];
    if (same) return same;
    const value = axis.back(start + point.position * span);
    const extinction = depthOf(point.opacity) / distance;
    return { value, colour: { r: 1, g: 1, b: 1 }, extinction };
  });
  return { ...result, opacities: next, knots: result.spline.knots };
}

/** Adds a point; the curve stays as it is. Beyond its ends it is the end's point. */
export function withCurvePointAt(curve: SmoothCurve, value: number) {
  const { opacities, axis } = curve;
  const x = placeOf(value, firstOf(opacities), lastOf(opacities), axis);
  return changedBy(curve, (spline) => withPointOn(spline, x));
}

/** Removes an inner point. */
export function withoutCurvePoint(curve: SmoothCurve, index: number) {
  return changedBy(curve, (spline) => ({ spline: withoutPointOf(spline, index) }));
}

/** Of numbers that rounding in double precision tells apart. */
const isClose = (a: number, b: number): boolean =>
  Math.abs(a - b) <= 1e-12 * Math.max(1, Math.abs(a), Math.abs(b));

/** One point where rounding made two: parts of a curve meet at colours, or within an ulp of them. */
const withoutTwins = (map: TransferFunction): TransferFunction =>
  map.filter((point, i) => {
    const before = map[i - 1];
    const numbers = ({ value, extinction, colour }: Point): number[] => [
      value,
      extinction,
      colour.r,
      colour.g,
      colour.b,
    ];
    const other = before && numbers(before);
    return !other || !numbers(point).every((x, k) => isClose(x, other[k] ?? Number.NaN));
  });

/**
 * A map whose opacities over `distance` follow a spline towards those of its points; colours are
 * straight between theirs.
 */
export function smoothed(apart: Apart, distance: number, axis: Axis): TransferFunction {
  const { colours, opacities, knots } = apart;
  const first = Math.min(firstOf(colours), firstOf(opacities));
  const last = Math.max(lastOf(colours), lastOf(opacities));
  if (!(last > first))
    return opacities.map((p, i) => ({ ...p, colour: colours[i]?.colour ?? p.colour }));
  const points = placed({ opacities, distance, axis }, first, last);
  const curve = withoutIdleKnots({ points, knots });
  const drawn = {
    colours: withoutIdlePoints(colours, axis.along).map(({ value, colour }) => ({
      position: placeOf(value, first, last, axis),
      colour,
    })),
    opacities: curve.points,
    knots: curve.knots,
    degree: 3,
    distance,
  } as const;
  return withoutTwins(resolved(drawn, { first, last }, axis));
}
