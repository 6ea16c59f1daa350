import { above, below, type Knot } from "./drawn_map";
import { type Axis, kStraight } from "./scale";
import { mixColour } from "./srgb";
import { type Point, stretched, type TransferFunction } from "./transfer_function";

/**
 * A map whose colours and extinctions have points of their own, each as many as they like; of the
 * points of one the other part has no meaning.
 */
export interface Apart {
  readonly colours: TransferFunction;
  readonly opacities: TransferFunction;
  /** Of opacities that follow a spline, see transfer/spline.ts; absent: uniform. */
  readonly knots?: readonly number[] | undefined;
}

const white = { r: 1, g: 1, b: 1 } as const;

type Numbers = readonly number[];

/** True where `b` lies on the line from `a` to `c`: the server keeps float32, whose rounding is no corner. */
function isStraight(a: Numbers, b: Numbers, c: Numbers, t: number): boolean {
  return b.every((x, k) => {
    const [from, to] = [a[k] ?? 0, c[k] ?? 0];
    return Math.abs(x - (from + t * (to - from))) <= 1e-6 * Math.max(Math.abs(from), Math.abs(to));
  });
}

/** The points that a part of the map needs: its ends and its corners. */
function corners(
  map: TransferFunction,
  part: (point: Point) => Numbers,
  { along }: Axis,
): TransferFunction {
  const kept: Point[] = [];
  map.forEach((point, i) => {
    const before = kept[kept.length - 1];
    const after = map[i + 1];
    const span = before && after ? along(after.value) - along(before.value) : 0;
    const t = before && span > 0 ? (along(point.value) - along(before.value)) / span : 0;
    const needed = !before || !after || !isStraight(part(before), part(point), part(after), t);
    if (needed) kept.push(point);
  });
  return kept;
}

/** Takes a map apart. Joined again it shows the same, but for the rounding of float32. */
export function takenApart(map: TransferFunction, axis: Axis = kStraight): Apart {
  const colours = corners(map, ({ colour: { r, g, b } }) => [r, g, b], axis);
  const opacities = corners(map, ({ extinction }) => [extinction], axis);
  return split(colours, opacities);
}

function split(colours: TransferFunction, opacities: TransferFunction): Apart {
  return {
    colours: colours.map((point) => ({ ...point, extinction: 0 })),
    opacities: opacities.map((point) => ({ ...point, colour: white })),
  };
}

/** Takes a map apart and keeps all of its points for both parts: a spline hangs on each of them. */
export const bothOf = (map: TransferFunction): Apart => split(map, map);

/** The same shape over another range, as stretched(): both parts by the range of both. */
export function stretchedApart(
  apart: Apart,
  first: number,
  last: number,
  axis: Axis = kStraight,
): Apart {
  const { colours, opacities, knots } = apart;
  const map = joined(apart, axis);
  const [from, to] = [map[0]?.value ?? 0, map[map.length - 1]?.value ?? 0];
  const end = knots?.[knots.length - 1] ?? 0;
  return {
    colours: stretched(colours, first, last, axis, { from, to }),
    opacities: stretched(opacities, first, last, axis, { from, to }),
    knots: first > last ? knots?.map((knot) => end - knot).reverse() : knots,
  };
}

const mixNumber = (a: number, b: number, t: number): number => a + t * (b - a);

/** One map of both: a point wherever either has one, two where it steps. */
export function joined({ colours, opacities }: Apart, axis: Axis = kStraight): TransferFunction {
  const knots = <Value>(map: TransferFunction, of: (p: Point) => Value): Knot<Value>[] =>
    map.map((point) => ({ position: axis.along(point.value), value: of(point) }));
  const colourLine = knots(colours, (p) => p.colour);
  const opacityLine = knots(opacities, (p) => p.extinction);
  const values = [...new Set([...colours, ...opacities].map((p) => p.value))].sort((a, b) => a - b);
  return values.flatMap((value): Point[] => {
    const at = axis.along(value);
    const point = (side: typeof below): Point => ({
      value,
      colour: side(colourLine, at, mixColour),
      extinction: side(opacityLine, at, mixNumber),
    });
    const [first, second] = [point(below), point(above)];
    const { colour: a } = first;
    const { colour: b } = second;
    const steps =
      first.extinction !== second.extinction || a.r !== b.r || a.g !== b.g || a.b !== b.b;
    return steps ? [first, second] : [first];
  });
}
