import { bends } from "./bends";
import { resolved } from "./drawn_map";
import { opacityFromExtinction } from "./opacity";
import { type ColourSpace, colourBetween, kColourSpaces } from "./paraview_colours";
import { type Axis, kStraight } from "./scale";
import { type Colour, encodeSrgb } from "./srgb";
import { sampleAt, type TransferFunction } from "./transfer_function";

/** A colour map as ParaView, VTK and vtk.js keep it: numbers of the display, 0 to 1. */
interface Preset {
  readonly Name?: unknown;
  readonly ColorSpace?: unknown;
  readonly RGBPoints?: unknown;
  readonly Points?: unknown;
}

export interface ReadPreset {
  readonly name: string;
  readonly map: TransferFunction;
  /** Whether it says opacities, too. */
  readonly hasOpacity: boolean;
}

/** Half a step of a display's byte. */
const kError = 0.5 / 255;

function rows(value: unknown, width: number, name: string): number[][] {
  if (!Array.isArray(value) || value.length === 0 || value.length % width !== 0) {
    throw new Error(`${name} is no list of ${width} numbers a point`);
  }
  const numbers = value.map(Number);
  const wrong = numbers.findIndex((x) => !Number.isFinite(x));
  if (wrong >= 0) throw new Error(`${name}[${wrong}] is no number`);
  const all: number[][] = [];
  for (let i = 0; i < numbers.length; i += width) all.push(numbers.slice(i, i + width));
  if (all.some((row, i) => i > 0 && (row[0] ?? 0) < (all[i - 1]?.[0] ?? 0))) {
    throw new Error(`the values of ${name} do not ascend`);
  }
  return all;
}

interface ColourKnot {
  readonly value: number;
  readonly colour: Colour;
}

const toDisplay = (rgb: readonly number[]): readonly number[] => rgb.map(encodeSrgb);

/** Between two points the way is that of the map's colour space; here it is straight in light. */
function coloursOf(points: readonly number[][], space: ColourSpace): ColourKnot[] {
  return points.flatMap(([value = 0, ...rgb], i): ColourKnot[] => {
    const [after = value, ...to] = points[i + 1] ?? [];
    const colourAt = colourBetween(space, rgb, after > value ? to : rgb);
    const numbers = (t: number): readonly number[] => {
      const { r, g, b } = colourAt(t);
      return [r, g, b];
    };
    const places = after > value ? bends(numbers, toDisplay, kError) : [];
    return [0, ...places].map((t) => ({
      value: value + t * (after - value),
      colour: colourAt(t),
    }));
  });
}

/**
 * Reads a colour map of ParaView, VTK or vtk.js: `[{"Name", "ColorSpace", "RGBPoints", "Points"}]`.
 * Opacities count over `distance`, in world units; midpoints other than 0.5 are refused.
 */
export function readPreset(json: unknown, distance: number): ReadPreset {
  const preset = (Array.isArray(json) ? json[0] : json) as Preset | null | undefined;
  if (typeof preset !== "object" || preset === null) throw new Error("it holds no colour map");
  const space = kColourSpaces.find((s) => s === (preset.ColorSpace ?? "RGB"));
  if (!space) {
    const known = kColourSpaces.join(", ");
    throw new Error(`ColorSpace ${String(preset.ColorSpace)} is not one of ${known}`);
  }
  const colours = coloursOf(rows(preset.RGBPoints, 4, "RGBPoints"), space);
  const first = colours[0]?.value ?? 0;
  const last = colours[colours.length - 1]?.value ?? first;
  if (!(last > first)) throw new Error("RGBPoints are all at one value");
  const hasOpacity = preset.Points !== undefined && preset.Points !== null;
  const opacities = hasOpacity ? rows(preset.Points, 4, "Points") : [[first, 1, 0.5, 0]];
  if (opacities.some(([, , middle, sharp]) => middle !== 0.5 || sharp !== 0)) {
    throw new Error("its opacities have midpoints or sharpness, which are not supported");
  }
  const place = (value: number): number =>
    Math.min(1, Math.max(0, (value - first) / (last - first)));
  const map = resolved(
    {
      colours: colours.map(({ value, colour }) => ({ position: place(value), colour })),
      opacities: opacities.map(([value = 0, opacity = 0]) => ({
        position: place(value),
        opacity: Math.min(1, Math.max(0, opacity)),
      })),
      degree: 1,
      distance,
    },
    { first, last },
    kStraight,
  );
  const name = typeof preset.Name === "string" ? preset.Name : "";
  return { name, map, hasOpacity };
}

const rounded = (x: number): number => Number(x.toPrecision(9));

/** The same map for ParaView, VTK and vtk.js, in as many points as keep it within half a byte. */
export function writePreset(
  map: TransferFunction,
  name: string,
  distance: number,
  axis: Axis = kStraight,
): readonly unknown[] {
  const shownAt = (value: number): readonly number[] => {
    const { colour, extinction } = sampleAt(map, value, axis.along);
    const { r, g, b } = colour;
    return [...toDisplay([r, g, b]), opacityFromExtinction(extinction, distance)];
  };
  const values = map.flatMap(({ value }, i) => {
    const next = map[i + 1]?.value ?? value;
    const between = (t: number): number => value + t * (next - value);
    const places =
      next > value
        ? bends(
            (t) => shownAt(between(t)),
            (x) => x,
            kError,
          )
        : [];
    return [value, ...places.map(between)];
  });
  const shown = [...new Set(values)].map((value) => [value, ...shownAt(value)].map(rounded));
  return [
    {
      Name: name,
      ColorSpace: "RGB",
      RGBPoints: shown.flatMap(([value = 0, r = 0, g = 0, b = 0]) => [value, r, g, b]),
      Points: shown.flatMap(([value = 0, , , , opacity = 0]) => [value, opacity, 0.5, 0]),
    },
  ];
}
