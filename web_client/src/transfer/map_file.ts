import { type Apart, bothOf } from "./apart";
import type { Colour } from "./srgb";
import type { Point, TransferFunction } from "./transfer_function";

/** A map as it is edited; see MapEdit. */
export interface EditedMap {
  readonly map: TransferFunction;
  readonly density: number;
  readonly smooth?: number | undefined;
  readonly apart?: Apart | undefined;
}

/** As `volcast render --map` reads it, too, which takes "points" alone: what is drawn. */
interface MapFile {
  readonly points: TransferFunction;
  /** All that the editor knows besides. */
  readonly editor?: EditedMap;
}

export const kKind = "volcast transfer function";

/** `drawn`: the points as they are sent. */
export function writeMap(edit: EditedMap, drawn: TransferFunction): MapFile & { kind: string } {
  const { map, density, smooth, apart } = edit;
  return { kind: kKind, points: drawn, editor: { map, density, smooth, apart } };
}

function finite(value: unknown, name: string): number {
  if (typeof value === "number" && Number.isFinite(value)) return value;
  throw new Error(`${name} is no number`);
}

const object = (value: unknown, name: string): Record<string, unknown> => {
  if (typeof value === "object" && value !== null) return value as Record<string, unknown>;
  throw new Error(`${name} is missing`);
};

function colourOf(value: unknown, name: string): Colour {
  const { r, g, b } = object(value, name);
  const part = (x: unknown, k: string): number =>
    Math.min(1, Math.max(0, finite(x ?? 0, `${name}.${k}`)));
  return { r: part(r, "r"), g: part(g, "g"), b: part(b, "b") };
}

function pointsOf(value: unknown, name: string): TransferFunction {
  if (!Array.isArray(value) || value.length === 0) throw new Error(`${name} is no list of points`);
  const points = value.map((item: unknown, i): Point => {
    const path = `${name}[${i}]`;
    const { value: at, colour, extinction } = object(item, path);
    const sigma = finite(extinction ?? 0, `${path}.extinction`);
    if (sigma < 0) throw new Error(`${path}.extinction is below 0`);
    return {
      value: finite(at, `${path}.value`),
      colour: colourOf(colour, `${path}.colour`),
      extinction: sigma,
    };
  });
  const wrong = points.findIndex((p, i) => i > 0 && p.value < (points[i - 1]?.value ?? p.value));
  if (wrong >= 0) throw new Error(`${name}[${wrong}].value is below the one before it`);
  return points;
}

function knotsOf(value: unknown, count: number, name: string): readonly number[] | undefined {
  if (value === undefined || value === null) return undefined;
  if (!Array.isArray(value)) throw new Error(`${name} is no list`);
  const knots = value.map((knot: unknown, i) => finite(knot, `${name}[${i}]`));
  const wrong = knots.findIndex((knot, i) => i > 0 && knot <= (knots[i - 1] ?? knot));
  if (wrong >= 0) throw new Error(`${name}[${wrong}] is not above the one before it`);
  const wanted = Math.max(2, count - 2);
  if (knots.length !== wanted)
    throw new Error(`${name} has ${knots.length} numbers, not ${wanted}`);
  return knots;
}

function apartOf(value: unknown, name: string): Apart | undefined {
  if (value === undefined || value === null) return undefined;
  const parts = object(value, name);
  const colours = pointsOf(parts.colours, `${name}.colours`);
  const opacities = pointsOf(parts.opacities, `${name}.opacities`);
  const knots = knotsOf(parts.knots, opacities.length, `${name}.knots`);
  return knots ? { colours, opacities, knots } : { colours, opacities };
}

/** A map as it is edited, at `name` in a file. Errors: what is wrong, with its place. */
export function editedMapOf(value: unknown, name: string): EditedMap {
  const { map, density, smooth, apart } = object(value, name);
  const factor = finite(density ?? 1, `${name}.density`);
  if (factor <= 0) throw new Error(`${name}.density is not above 0`);
  const length =
    smooth === undefined || smooth === null ? undefined : finite(smooth, `${name}.smooth`);
  if (length !== undefined && length <= 0) throw new Error(`${name}.smooth is not above 0`);
  const points = pointsOf(map, `${name}.map`);
  const parts = apartOf(apart, `${name}.apart`);
  // A curve hangs on opacities of its own; files from before that have those of the map.
  return {
    map: points,
    density: factor,
    smooth: length,
    apart: parts ?? (length === undefined ? undefined : bothOf(points)),
  };
}

/** Errors: what is wrong, with its place in the file. */
export function readMap(json: unknown): EditedMap {
  const file = object(json, "the map");
  const points = pointsOf(file.points, "points");
  return file.editor === undefined
    ? { map: points, density: 1 }
    : editedMapOf(file.editor, "editor");
}

/** Whether a file is one of ours; else it is tried as a preset of ParaView. */
export const isOwnMap = (json: unknown): boolean =>
  typeof json === "object" && json !== null && !Array.isArray(json) && "points" in json;
