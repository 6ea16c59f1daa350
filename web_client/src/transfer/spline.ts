import type { OpacityPoint } from "./opacity_curve";

/** A clamped B-spline: cubic, or of a lower degree where it has fewer than four points. */
export interface Spline {
  readonly points: readonly OpacityPoint[];
  /** As OpacityCurve has them; absent: 0, 1, 2 ... Those that are no whole numbers were inserted. */
  readonly knots?: readonly number[] | undefined;
}

const kDegree = 3;
/** A new knot keeps this part of its span from the others: where knots meet, a curve has a corner. */
const kClear = 0.1;
/** How far control points of the same curve may be apart, in parts of the window and in opacity. */
const kSame = 1e-9;

const lerp = (a: number, b: number, t: number): number => a + t * (b - a);

const mixed = (a: OpacityPoint, b: OpacityPoint, t: number): OpacityPoint => ({
  position: lerp(a.position, b.position, t),
  opacity: lerp(a.opacity, b.opacity, t),
});

const pointAt = ({ points }: Spline, i: number): OpacityPoint => points[i] as OpacityPoint;

export function knotsOf({ points, knots }: Spline): readonly number[] {
  const count = Math.max(2, points.length - kDegree + 1);
  return knots?.length === count ? knots : Array.from({ length: count }, (_, i) => i);
}

/** Of the knots with their ends repeated: 0 to points.length + 3. */
const knotAt = (knots: readonly number[], i: number): number =>
  knots[Math.min(knots.length - 1, Math.max(0, i - kDegree))] ?? 0;

/** How far point `i` of the curve with knot `u` lies from the one before to the one after it. */
function shareOf(knots: readonly number[], i: number, u: number): number {
  const low = knotAt(knots, i);
  return (u - low) / (knotAt(knots, i + kDegree) - low);
}

/** Boehm's knot insertion (W. Boehm 1980): the same curve by one point more; `u` is no knot yet. */
function inserted(spline: Spline, u: number): Spline {
  const knots = knotsOf(spline);
  const span = knots.findIndex((knot) => knot > u) + kDegree - 1;
  const points = Array.from({ length: spline.points.length + 1 }, (_, i) => {
    if (i <= span - kDegree) return pointAt(spline, i);
    if (i > span) return pointAt(spline, i - 1);
    return mixed(pointAt(spline, i - 1), pointAt(spline, i), shareOf(knots, i, u));
  });
  return { points, knots: [...knots, u].sort((a, b) => a - b) };
}

/** Moves `u` clear of the knots about it, and off whole numbers. */
function cleared(knots: readonly number[], u: number): number {
  const at = Math.max(
    1,
    Math.min(
      knots.length - 1,
      knots.findIndex((knot) => knot > u),
    ),
  );
  const low = knots[at - 1] ?? 0;
  const width = (knots[at] ?? low + 1) - low;
  const moved = low + width * Math.min(1 - kClear, Math.max(kClear, (u - low) / width));
  return Number.isInteger(moved) ? moved + kClear * width : moved;
}

/** The same curve, by one degree more, of three points: there are no knots between its ends. */
function elevated({ points: [a, b, c] }: Spline): Spline {
  if (!a || !b || !c) throw new Error("three points are wanted");
  return { points: [a, mixed(a, b, 2 / 3), mixed(b, c, 1 / 3), c] };
}

const nearest = ({ points }: Spline, x: number): number =>
  points
    .map((point, i) => ({ i, off: Math.abs(point.position - x) }))
    .slice(1, -1)
    .reduce((best, one) => (one.off < best.off ? one : best)).i;

/**
 * Adds a point at x on the line between its neighbours, which move towards it: the curve stays
 * where it is. Beyond the ends, and where there is a point, it is that point.
 */
export function withPointOn(spline: Spline, x: number): { spline: Spline; index: number } {
  const { points } = spline;
  const after = points.findIndex((p) => p.position >= x);
  if (after < 0) return { spline, index: points.length - 1 };
  const before = points[after - 1];
  const next = points[after];
  if (!before || !next || next.position === x) return { spline, index: after };
  const t = (x - before.position) / (next.position - before.position);
  if (points.length === 2) {
    return {
      spline: { points: [before, { ...mixed(before, next, t), position: x }, next] },
      index: 1,
    };
  }
  if (points.length === 3) {
    const same = elevated(spline);
    return { spline: same, index: nearest(same, x) };
  }
  const knots = knotsOf(spline);
  const u = cleared(knots, lerp(knotAt(knots, after), knotAt(knots, after + kDegree), t));
  const same = inserted(spline, u);
  return { spline: same, index: nearest(same, x) };
}

/** The same curve without knot `at` of knotsOf(); undefined where it has a use. */
function without(spline: Spline, at: number): Spline | undefined {
  const all = knotsOf(spline);
  const u = all[at] ?? 0;
  const knots = all.filter((_, i) => i !== at);
  const span = at - 1 + kDegree;
  const share = (i: number): number => shareOf(knots, i, u);
  const left = pointAt(spline, span - 3);
  const right = pointAt(spline, span + 1);
  const [a, b] = [share(span - 2), share(span)];
  // Insertion backwards: from the left, and from the right; in the middle both have to meet.
  const first = mixed(left, pointAt(spline, span - 2), 1 / a);
  const second = mixed(right, pointAt(spline, span), 1 / (1 - b));
  const middle = mixed(first, second, share(span - 1));
  const was = pointAt(spline, span - 1);
  const off = Math.max(
    Math.abs(middle.position - was.position),
    Math.abs(middle.opacity - was.opacity),
  );
  if (!(off <= kSame)) return undefined;
  const kept = (p: OpacityPoint): OpacityPoint => ({ ...p, opacity: Math.max(0, p.opacity) });
  const points = [
    ...spline.points.slice(0, span - 2),
    kept(first),
    kept(second),
    ...spline.points.slice(span + 1),
  ];
  return { points, knots };
}

/** Uniform knots need not be said. */
const plain = ({ points, knots }: Spline): Spline =>
  !knots || knots.every((knot, i) => knot === i) ? { points } : { points, knots };

/** Which of the inserted knots may have no use. */
const insertedKnots = (spline: Spline): number[] =>
  knotsOf(spline).flatMap((knot, i) => (Number.isInteger(knot) ? [] : [i]));

/**
 * Without inserted knots that change nothing. What is drawn is made of the others alone: a point
 * that is added and not moved yet leaves the picture as it is.
 */
export function withoutIdleKnots(spline: Spline): Spline {
  const kept = insertedKnots(spline).reduceRight(
    (curve, at) => without(curve, at) ?? curve,
    spline,
  );
  return plain(kept);
}

/** Removes an inner point: without a change where a point beside it has no use, else with its knot. */
export function withoutPointOf(spline: Spline, index: number): Spline {
  for (const at of insertedKnots(spline)) {
    const span = at - 1 + kDegree;
    const same = index >= span - 2 && index <= span ? without(spline, at) : undefined;
    if (same) return plain(same);
  }
  const points = spline.points.filter((_, i) => i !== index);
  const knots = knotsOf(spline);
  if (!spline.knots || knots.length < 3) return { points };
  // The knot in the middle of those that the point hangs on.
  const own = Math.max(1, Math.min(knots.length - 2, index + 2 - kDegree));
  return plain({ points, knots: knots.filter((_, i) => i !== own) });
}
