import { colourOf, kColourMaps } from "../transfer/colour_maps";
import { encodeSrgb } from "../transfer/srgb";

const kEntries = 256;

function tableOf(): Uint8ClampedArray {
  const map = kColourMaps.find((m) => m.id === "inferno") ?? kColourMaps[0];
  const table = new Uint8ClampedArray(3 * kEntries);
  if (!map) return table;
  for (let i = 0; i < kEntries; i += 1) {
    const { r, g, b } = colourOf(map, i / (kEntries - 1));
    table.set(
      [r, g, b].map((c) => Math.round(255 * encodeSrgb(c))),
      3 * i,
    );
  }
  return table;
}

const kTable = tableOf();

/** The scale's colour of a part from 0 to 1, as a browser paints it. */
export function scaleColour(part: number): string {
  const at = 3 * Math.round(Math.min(1, Math.max(0, part)) * (kEntries - 1));
  return `rgb(${kTable[at]} ${kTable[at + 1]} ${kTable[at + 2]})`;
}

/**
 * RGBA8 of differences (1 is white), black where there is none, the scale's last colour from `range`
 * (in 1/255) on; nothing where a difference is not known.
 */
export function paintDifference(off: Float32Array, range: number): Uint8ClampedArray<ArrayBuffer> {
  const rgba = new Uint8ClampedArray(4 * off.length);
  const scale = (255 / range) * (kEntries - 1);
  for (let i = 0; i < off.length; i += 1) {
    const value = off[i] ?? Number.NaN;
    if (Number.isNaN(value)) continue;
    const at = 3 * Math.min(kEntries - 1, Math.round(value * scale));
    rgba[4 * i] = kTable[at] ?? 0;
    rgba[4 * i + 1] = kTable[at + 1] ?? 0;
    rgba[4 * i + 2] = kTable[at + 2] ?? 0;
    rgba[4 * i + 3] = 255;
  }
  return rgba;
}
