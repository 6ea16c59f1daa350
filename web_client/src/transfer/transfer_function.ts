import { type Along, type Axis, kStraight } from "./scale";
import { type Colour, mixColour } from "./srgb";

/** One point of the map: value in the field's unit, linear colour, extinction per world unit. */
export interface Point {
  readonly value: number;
  readonly colour: Colour;
  readonly extinction: number;
}

/** Piecewise linear in value, clamped outside; at least one point, values ascend. */
export type TransferFunction = readonly Point[];

const replaced = (map: TransferFunction, index: number, point: Point): TransferFunction =>
  map.map((p, i) => (i === index ? point : p));

const clamp = (x: number, low: number, high: number): number => Math.min(high, Math.max(low, x));

/** What the map, straight in `along`, gives at `value`: exactly what the renderer draws there. */
export function sampleAt(
  map: TransferFunction,
  value: number,
  along: Along = kStraight.along,
): Point {
  const first = map[0];
  const last = map[map.length - 1];
  if (!first || !last) return { value, colour: { r: 1, g: 1, b: 1 }, extinction: 0 };
  if (value <= first.value) return { ...first, value };
  if (value >= last.value) return { ...last, value };
  const at = map.findIndex((p) => p.value >= value);
  const far = map[at] ?? last;
  const near = map[at - 1] ?? first;
  const span = along(far.value) - along(near.value);
  const t = span > 0 ? (along(value) - along(near.value)) / span : 1;
  return {
    value,
    colour: mixColour(near.colour, far.colour, t),
    extinction: near.extinction + t * (far.extinction - near.extinction),
  };
}

/** Adds a point with the map's own value there, so that nothing changes until it is moved. */
export function withPointAt(
  map: TransferFunction,
  value: number,
  along: Along = kStraight.along,
): { map: TransferFunction; index: number } {
  const same = map.findIndex((p) => p.value === value);
  if (same >= 0) return { map, index: same };
  const after = map.findIndex((p) => p.value > value);
  const index = after < 0 ? map.length : after;
  return { map: [...map.slice(0, index), sampleAt(map, value, along), ...map.slice(index)], index };
}

/** Removes an inner point; the ends stay, they carry the map's range. */
export function withoutPoint(map: TransferFunction, index: number): TransferFunction {
  return isEnd(map, index) ? map : map.filter((_, i) => i !== index);
}

export function isEnd(map: TransferFunction, index: number): boolean {
  return index <= 0 || index >= map.length - 1;
}

/** Moves a point; inner points stay between their neighbours, ends keep their value. */
export function withMovedPoint(
  map: TransferFunction,
  index: number,
  value: number,
  extinction: number,
): TransferFunction {
  const point = map[index];
  if (!point) return map;
  const before = map[index - 1];
  const after = map[index + 1];
  const kept =
    before && after && Number.isFinite(value)
      ? clamp(value, before.value, after.value)
      : point.value;
  const positive = Number.isFinite(extinction) ? Math.max(0, extinction) : point.extinction;
  return replaced(map, index, { ...point, value: kept, extinction: positive });
}

export function withColour(map: TransferFunction, index: number, colour: Colour): TransferFunction {
  const point = map[index];
  return point ? replaced(map, index, { ...point, colour }) : map;
}

/** All extinctions times `factor`. */
export function scaled(map: TransferFunction, factor: number): TransferFunction {
  return map.map((p) => ({ ...p, extinction: p.extinction * factor }));
}

/** The ends of a map. */
const endsOf = (map: TransferFunction) => ({
  from: map[0]?.value ?? 0,
  to: map[map.length - 1]?.value ?? 0,
});

/**
 * The same shape over another range of values, turned round where `first` is above `last`; `ends`
 * come to lie there, which are the map's own where it is no part of a wider one.
 */
export function stretched(
  map: TransferFunction,
  first: number,
  last: number,
  axis: Axis = kStraight,
  ends: { readonly from: number; readonly to: number } = endsOf(map),
): TransferFunction {
  const { along, back } = axis;
  const start = along(ends.from);
  const span = along(ends.to) - start;
  const next = map.map((p, i) => {
    const t = span > 0 ? (along(p.value) - start) / span : i / Math.max(1, map.length - 1);
    if (t === 0 || t === 1) return { ...p, value: t === 0 ? first : last };
    return { ...p, value: back(along(first) + t * (along(last) - along(first))) };
  });
  return first > last ? next.reverse() : next;
}

/** Of a point on the line between its neighbours; rounding in double precision is no corner. */
const kOnLine = 1e-9;

function isOnLine(before: Point, point: Point, after: Point, along: Along): boolean {
  const span = along(after.value) - along(before.value);
  const t = span > 0 ? (along(point.value) - along(before.value)) / span : 0;
  const parts = ({ colour: { r, g, b }, extinction }: Point) => [r, g, b, extinction];
  const [from, to] = [parts(before), parts(after)];
  return parts(point).every((x, k) => {
    const [a, b] = [from[k] ?? 0, to[k] ?? 0];
    return Math.abs(x - (a + t * (b - a))) <= kOnLine * Math.max(Math.abs(a), Math.abs(b));
  });
}

/**
 * Without points that change nothing. What is drawn is made of the others alone, so a point that
 * is added and not moved yet leaves the picture as it is, to the last bit.
 */
export function withoutIdlePoints(
  map: TransferFunction,
  along: Along = kStraight.along,
): TransferFunction {
  const kept: Point[] = [];
  map.forEach((point, i) => {
    const before = kept[kept.length - 1];
    const after = map[i + 1];
    if (!before || !after || !isOnLine(before, point, after, along)) kept.push(point);
  });
  return kept;
}

/** Colours from the last value to the first; extinction stays where it is. */
export function withReversedColours(
  map: TransferFunction,
  { along, back }: Axis = kStraight,
): TransferFunction {
  const first = map[0]?.value ?? 0;
  const last = map[map.length - 1]?.value ?? 0;
  const mirrored = (value: number): number => {
    if (value === first || value === last) return value === first ? last : first;
    return back(along(first) + along(last) - along(value));
  };
  const values = [...map.map((p) => p.value), ...map.map((p) => mirrored(p.value))];
  const ascending = [...new Set(values)].sort((a, b) => a - b);
  const turned = ascending.map((value) => ({
    value,
    colour: sampleAt(map, mirrored(value), along).colour,
    extinction: sampleAt(map, value, along).extinction,
  }));
  return withoutIdlePoints(turned, along);
}
