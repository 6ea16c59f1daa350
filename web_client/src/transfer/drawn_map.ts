import { OpacityCurve, type OpacityPoint } from "./opacity_curve";
import { type Axis, kStraight } from "./scale";
import { type Colour, mixColour } from "./srgb";
import type { Point, TransferFunction } from "./transfer_function";

export interface ColourPoint {
  readonly position: number;
  /** Linear RGB. */
  readonly colour: Colour;
}

/**
 * A transfer function as editors draw it: colours and opacities apart, each as many as it likes.
 * Positions run from 0 to 1 over a window and do not fall; two equal ones make a step. The twin of
 * renderer/data/drawn_map.h.
 */
export interface DrawnMap {
  readonly colours: readonly ColourPoint[];
  /** In [0, 1] over `distance`. */
  readonly opacities: readonly OpacityPoint[];
  /** Of the opacity's curve: 3, or 1 for straight lines. */
  readonly degree: 1 | 3;
  /** Of the opacity's curve, see OpacityCurve; absent: uniform, as the server's twin has them. */
  readonly knots?: readonly number[] | undefined;
  /** World units, > 0. */
  readonly distance: number;
}

/** The values that positions 0 and 1 stand for; first > last: the map runs from high to low. */
export interface Window {
  readonly first: number;
  readonly last: number;
}

/** How far the opacity of resolved() is from the curve, at most. */
export const kOpacityError = 1 / 1024;

/** Opacities count as at most this: 1 would need infinite extinction. */
export const kMostOpacity = 1 - 2 ** -24;

/** A point of a piecewise linear function, steps included. */
export interface Knot<Value> {
  readonly position: number;
  readonly value: Value;
}

type Mix<Value> = (a: Value, b: Value, t: number) => Value;

/** Before the step where there is one at `position`. */
export function below<Value>(
  line: readonly Knot<Value>[],
  position: number,
  mix: Mix<Value>,
): Value {
  const at = line.findIndex((knot) => knot.position >= position);
  const far = line[at < 0 ? line.length - 1 : at] as Knot<Value>;
  const near = line[at - 1];
  if (at < 0 || !near || far.position === position) return far.value;
  return mix(near.value, far.value, (position - near.position) / (far.position - near.position));
}

/** After the step where there is one at `position`. */
export function above<Value>(
  line: readonly Knot<Value>[],
  position: number,
  mix: Mix<Value>,
): Value {
  for (let i = line.length - 1; i >= 0; i -= 1) {
    const knot = line[i];
    if (knot && knot.position === position) return knot.value;
    if (knot && knot.position < position) break;
  }
  return below(line, position, mix);
}

const lerp: Mix<number> = (a, b, t) => a + t * (b - a);

/** What opacity is straight in: extinction times distance. */
export const depthOf = (opacity: number): number => -Math.log1p(-Math.min(opacity, kMostOpacity));

interface Stretch {
  readonly x0: number;
  readonly x1: number;
  readonly depth0: number;
  readonly depth1: number;
  readonly halvings: number;
}

/** A curve that stands upright ends in a step of 2^-40 of its span. */
const kMostHalvings = 40;
/** A quarter of the error is left for places between those that are looked at. */
const kLookedFor = 0.75 * kOpacityError;

function closeEnough(curve: OpacityCurve, span: number, s: Stretch): boolean {
  return [0.5, 0.25, 0.75, 0.1, 0.9].every((t) => {
    const drawn = Math.min(curve.at(span, lerp(s.x0, s.x1, t)), kMostOpacity);
    const line = -Math.expm1(-lerp(s.depth0, s.depth1, t));
    return Math.abs(line - drawn) <= kLookedFor;
  });
}

/** Appends points after x0, x1 last. */
function follow(curve: OpacityCurve, span: number, s: Stretch, into: Knot<number>[]): void {
  if (s.halvings >= kMostHalvings || closeEnough(curve, span, s)) {
    into.push({ position: s.x1, value: s.depth1 });
    return;
  }
  const middle = 0.5 * (s.x0 + s.x1);
  const depth = depthOf(curve.at(span, middle));
  const halvings = s.halvings + 1;
  follow(curve, span, { ...s, x1: middle, depth1: depth, halvings }, into);
  follow(curve, span, { ...s, x0: middle, depth0: depth, halvings }, into);
}

function depthsOf(map: DrawnMap): Knot<number>[] {
  const curve = new OpacityCurve(map.opacities, map.degree, map.knots);
  let from = curve.joint(0);
  const depths = [{ position: from.position, value: depthOf(from.opacity) }];
  for (let span = 0; span < curve.spans; span += 1) {
    const to = curve.joint(span + 1);
    const ends = { x0: from.position, x1: to.position };
    const known = { depth0: depthOf(from.opacity), depth1: depthOf(to.opacity), halvings: 0 };
    follow(curve, span, { ...ends, ...known }, depths);
    from = to;
  }
  return depths;
}

function valueAt(window: Window, axis: Axis, position: number): number {
  if (position === 0 || position === 1) return position === 0 ? window.first : window.last;
  return axis.back(lerp(axis.along(window.first), axis.along(window.last), position));
}

/** Both functions at all positions where either has a point. */
function merged(
  colours: readonly Knot<Colour>[],
  depths: readonly Knot<number>[],
  distance: number,
  window: Window,
  axis: Axis,
): TransferFunction {
  const places = [...colours, ...depths].map((knot) => knot.position);
  const positions = [...new Set(places)].sort((a, b) => a - b);
  const points = positions.flatMap((position): Point[] => {
    const value = valueAt(window, axis, position);
    const point = (colour: Colour, depth: number): Point => ({
      value,
      colour,
      extinction: depth / distance,
    });
    const colour = below(colours, position, mixColour);
    const next = above(colours, position, mixColour);
    const depth = below(depths, position, lerp);
    const nextDepth = above(depths, position, lerp);
    const step =
      depth !== nextDepth ||
      [colour.r !== next.r, colour.g !== next.g, colour.b !== next.b].includes(true);
    return step ? [point(colour, depth), point(next, nextDepth)] : [point(colour, depth)];
  });
  return window.first > window.last ? points.reverse() : points;
}

/**
 * Control points of a drawn map: all colour points, and as many on the opacity's curve as make
 * lines in extinction follow it to kOpacityError. The window has a width.
 */
export function resolved(map: DrawnMap, window: Window, axis: Axis = kStraight): TransferFunction {
  const colours = map.colours.map(({ position, colour }) => ({ position, value: colour }));
  return merged(colours, depthsOf(map), map.distance, window, axis);
}

/** Entries r, g, b, opacity at equal steps over a window. */
export function fromTable(
  rgba: readonly (readonly [number, number, number, number])[],
  distance: number,
  window: Window,
  axis: Axis = kStraight,
): TransferFunction {
  const place = (i: number): number => (rgba.length > 1 ? i / (rgba.length - 1) : 0);
  const colours = rgba.map(([r, g, b], i) => ({ position: place(i), value: { r, g, b } }));
  const depths = rgba.map(([, , , a], i) => ({ position: place(i), value: depthOf(a) }));
  return merged(colours, depths, distance, window, axis);
}
