import type { Apart } from "./apart";
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

/** Errors: what is wrong, with its place in the file. */
export function readMap(json: unknown): EditedMap {
  const file = object(json, "the map");
  const points = pointsOf(file.points, "points");
  if (file.editor === undefined) return { map: points, density: 1 };
  const { map, density, smooth, apart } = object(file.editor, "editor");
  const factor = finite(density ?? 1, "editor.density");
  if (factor <= 0) throw new Error("editor.density is not above 0");
  const parts = apart === undefined || apart === null ? undefined : object(apart, "editor.apart");
  return {
    map: pointsOf(map, "editor.map"),
    density: factor,
    smooth: smooth === undefined || smooth === null ? undefined : finite(smooth, "editor.smooth"),
    apart: parts && {
      colours: pointsOf(parts.colours, "editor.apart.colours"),
      opacities: pointsOf(parts.opacities, "editor.apart.opacities"),
    },
  };
}

/** Whether a file is one of ours; else it is tried as a preset of ParaView. */
export const isOwnMap = (json: unknown): boolean =>
  typeof json === "object" && json !== null && !Array.isArray(json) && "points" in json;
