import { type Colour, fromHex, mixColour } from "./srgb";

/** A named colour map: colours at equal steps from the lowest value to the highest. */
export interface ColourMap {
  readonly id: string;
  readonly name: string;
  /** Who made it, and under which licence. */
  readonly source: string;
  readonly stops: readonly Colour[];
}

const kStops = 9;

/** OKLab to linear RGB. Source: B. Ottosson, "A perceptual color space", 2020 (public domain). */
function fromOklab(lightness: number, a: number, b: number): Colour {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const inGamut = (x: number): number => Math.min(1, Math.max(0, x));
  return {
    r: inGamut(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    g: inGamut(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    b: inGamut(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  };
}

const steps = (colourAt: (t: number) => Colour): Colour[] =>
  Array.from({ length: kStops }, (_, i) => colourAt(i / (kStops - 1)));

const table = (hex: string): Colour[] =>
  hex.split(" ").map((h) => fromHex(h) ?? { r: 0, g: 0, b: 0 });

/** Blue over light grey to red, lightness and chroma mirrored around the middle. */
function coolWarm(t: number): Colour {
  const side = 2 * Math.abs(t - 0.5);
  const hue = ((t < 0.5 ? 262 : 27) * Math.PI) / 180;
  const chroma = 0.17 * side;
  return fromOklab(0.92 - 0.4 * side, chroma * Math.cos(hue), chroma * Math.sin(hue));
}

/** A straight line in OKLab: equal steps of value are equal steps to the eye, for the colour-blind too. */
function blueYellow(t: number): Colour {
  const chroma = 0.13 * (2 * t - 1);
  return fromOklab(0.3 + 0.62 * t, -0.1 * chroma, chroma);
}

/** Nine of 256 colours each: R's and matplotlib's tables, which their authors gave away. */
const kVanDerWalt = "S. van der Walt and N. Smith, 2015; CC0";
/** Computed here. */
const kOwn = "Volcast, from OKLab (B. Ottosson, 2020, public domain); AGPL";

export const kViridis: ColourMap = {
  id: "viridis",
  name: "Viridis",
  source: kVanDerWalt,
  stops: table("#440154 #472d7b #3b528b #2c728e #21918c #28ae80 #5ec962 #addc30 #fde725"),
};

const kPlasma: ColourMap = {
  id: "plasma",
  name: "Plasma",
  source: kVanDerWalt,
  stops: table("#0d0887 #4c02a1 #7e03a8 #a92395 #cc4778 #e56b5d #f89540 #fdc527 #f0f921"),
};

const kInferno: ColourMap = {
  id: "inferno",
  name: "Inferno",
  source: kVanDerWalt,
  stops: table("#000004 #210c4a #57106e #8a226a #bc3754 #e45a31 #f98e09 #f9cb35 #fcffa4"),
};

const kMagma: ColourMap = {
  id: "magma",
  name: "Magma",
  source: kVanDerWalt,
  stops: table("#000004 #1d1147 #51127c #832681 #b73779 #e75263 #fc8961 #fec488 #fcfdbf"),
};

const own = (id: string, name: string, colourAt: (t: number) => Colour): ColourMap => ({
  id,
  name,
  source: kOwn,
  stops: steps(colourAt),
});

export const kColourMaps: readonly ColourMap[] = [
  kViridis,
  kPlasma,
  kInferno,
  kMagma,
  own("blue-yellow", "Blue to yellow", blueYellow),
  own("cool-warm", "Cool to warm", coolWarm),
  own("grey", "Grey", (t) => fromOklab(0.1 + 0.9 * t, 0, 0)),
];

/** The map's colour at t in [0, 1]. */
export function colourOf(map: ColourMap, t: number): Colour {
  const position = Math.min(1, Math.max(0, t)) * (map.stops.length - 1);
  const low = Math.min(Math.floor(position), map.stops.length - 2);
  const near = map.stops[low];
  const far = map.stops[low + 1];
  if (!near || !far) return { r: 1, g: 1, b: 1 };
  return mixColour(near, far, position - low);
}
