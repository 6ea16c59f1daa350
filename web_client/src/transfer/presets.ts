import { type ColourMap, colourOf, kViridis } from "./colour_maps";
import { extinctionFromOpacity } from "./opacity";
import { sampleAt, type TransferFunction } from "./transfer_function";

/** A named opacity curve: opacity over the reference length at t in [0, 1] of the value range. */
export interface OpacityShape {
  readonly id: string;
  readonly name: string;
  readonly knots: readonly (readonly [t: number, opacity: number])[];
}

export const kOpacityShapes: readonly OpacityShape[] = [
  {
    id: "ramp",
    name: "Rising",
    knots: [
      [0, 0],
      [1, 0.6],
    ],
  },
  {
    id: "fall",
    name: "Falling",
    knots: [
      [0, 0.6],
      [1, 0],
    ],
  },
  {
    id: "even",
    name: "Even",
    knots: [
      [0, 0.2],
      [1, 0.2],
    ],
  },
  {
    id: "ends",
    name: "Both ends",
    knots: [
      [0, 0.6],
      [0.4, 0],
      [0.6, 0],
      [1, 0.6],
    ],
  },
  {
    id: "shells",
    name: "Thin shells",
    knots: [
      [0, 0],
      [0.22, 0],
      [0.25, 0.7],
      [0.28, 0],
      [0.47, 0],
      [0.5, 0.7],
      [0.53, 0],
      [0.72, 0],
      [0.75, 0.7],
      [0.78, 0],
      [1, 0],
    ],
  },
];

/** Values that a curve needs: its ends and its corners, straight runs left out. */
function corners(map: TransferFunction, of: (i: number) => readonly number[]): number[] {
  return map
    .filter((point, i) => {
      const before = map[i - 1];
      const after = map[i + 1];
      if (!before || !after) return true;
      const span = after.value - before.value;
      const t = span > 0 ? (point.value - before.value) / span : 0;
      const low = of(i - 1);
      const high = of(i + 1);
      return of(i).some((x, k) => {
        const a = low[k] ?? 0;
        const b = high[k] ?? 0;
        return Math.abs(x - (a + t * (b - a))) > 1e-6 * Math.max(Math.abs(a), Math.abs(b), 1e-12);
      });
    })
    .map((point) => point.value);
}

const ascending = (values: number[]): number[] => [...new Set(values)].sort((a, b) => a - b);

function range(map: TransferFunction): [low: number, span: number] {
  const low = map[0]?.value ?? 0;
  return [low, (map[map.length - 1]?.value ?? low) - low];
}

/** The colours of `colours` over the map's range; its extinction stays as it is. */
export function withColourMap(map: TransferFunction, colours: ColourMap): TransferFunction {
  const [low, span] = range(map);
  if (span <= 0) return map.map((p) => ({ ...p, colour: colourOf(colours, 0.5) }));
  const stops = colours.stops.map((_, i) => low + (span * i) / (colours.stops.length - 1));
  const kept = corners(map, (i) => [map[i]?.extinction ?? 0]);
  return ascending([...stops, ...kept]).map((value) => ({
    value,
    colour: colourOf(colours, (value - low) / span),
    extinction: sampleAt(map, value).extinction,
  }));
}

/** The opacity curve `shape` over the map's range; its colours stay as they are. */
export function withOpacityShape(
  map: TransferFunction,
  shape: OpacityShape,
  referenceLength: number,
): TransferFunction {
  const [low, span] = range(map);
  const curve = shape.knots.map(([t, opacity]) => ({
    value: low + t * span,
    colour: { r: 0, g: 0, b: 0 },
    extinction: extinctionFromOpacity(opacity, referenceLength),
  }));
  const kept = corners(map, (i) => {
    const c = map[i]?.colour;
    return c ? [c.r, c.g, c.b] : [];
  });
  return ascending([...curve.map((p) => p.value), ...kept]).map((value) => ({
    value,
    colour: sampleAt(map, value).colour,
    extinction: sampleAt(curve, value).extinction,
  }));
}

/** What a field starts with: viridis, rising opacity. */
export function defaultMap(low: number, high: number, referenceLength: number): TransferFunction {
  const [a, b] = high > low ? [low, high] : [low - 0.5, low + 0.5];
  const plain = { colour: { r: 1, g: 1, b: 1 }, extinction: 0 };
  const ends: TransferFunction = [
    { value: a, ...plain },
    { value: b, ...plain, extinction: extinctionFromOpacity(0.6, referenceLength) },
  ];
  return withColourMap(ends, kViridis);
}
