import { type Colour, decodeSrgb } from "./srgb";

/** The colour spaces in which ParaView's maps go from point to point. */
export const kColourSpaces = ["RGB", "Lab", "Diverging", "HSV"] as const;
export type ColourSpace = (typeof kColourSpaces)[number];

type Triple = readonly [number, number, number];

/** CIE's constants, and the white of sRGB: D65 (IEC 61966-2-1). */
const kEpsilon = 216 / 24389;
const kKappa = 24389 / 27;
const kWhite: Triple = [0.9505, 1, 1.089];

const linear = ([r, g, b]: Triple): Colour => ({
  r: decodeSrgb(r),
  g: decodeSrgb(g),
  b: decodeSrgb(b),
});

function labOf(rgb: Triple): Triple {
  const { r, g, b } = linear(rgb);
  const xyz: Triple = [
    0.4124 * r + 0.3576 * g + 0.1805 * b,
    0.2126 * r + 0.7152 * g + 0.0722 * b,
    0.0193 * r + 0.1192 * g + 0.9505 * b,
  ];
  const f = (k: 0 | 1 | 2): number => {
    const t = xyz[k] / kWhite[k];
    return t > kEpsilon ? Math.cbrt(t) : (kKappa * t + 16) / 116;
  };
  return [116 * f(1) - 16, 500 * (f(0) - f(1)), 200 * (f(1) - f(2))];
}

function rgbOfLab([lightness, a, b]: Triple): Colour {
  const fy = (lightness + 16) / 116;
  const back = (f: number, k: 0 | 1 | 2): number =>
    kWhite[k] * (f ** 3 > kEpsilon ? f ** 3 : (116 * f - 16) / kKappa);
  const [x, y, z] = [back(fy + a / 500, 0), back(fy, 1), back(fy - b / 200, 2)];
  const inGamut = (v: number): number => Math.min(1, Math.max(0, v));
  return {
    r: inGamut(3.2406 * x - 1.5372 * y - 0.4986 * z),
    g: inGamut(-0.9689 * x + 1.8758 * y + 0.0415 * z),
    b: inGamut(0.0557 * x - 0.204 * y + 1.057 * z),
  };
}

const mix = (a: Triple, b: Triple, t: number): Triple => [
  a[0] + t * (b[0] - a[0]),
  a[1] + t * (b[1] - a[1]),
  a[2] + t * (b[2] - a[2]),
];

/** Polar Lab: magnitude, saturation, hue. */
function mshOf(rgb: Triple): Triple {
  const [lightness, a, b] = labOf(rgb);
  const magnitude = Math.hypot(lightness, a, b);
  const saturation = magnitude > 0.001 ? Math.acos(lightness / magnitude) : 0;
  return [magnitude, saturation, saturation > 0.001 ? Math.atan2(b, a) : 0];
}

const rgbOfMsh = ([m, s, h]: Triple): Colour =>
  rgbOfLab([m * Math.cos(s), m * Math.sin(s) * Math.cos(h), m * Math.sin(s) * Math.sin(h)]);

/** The hue that an unsaturated end takes, so that the other end's seems not to turn. */
function adjustedHue([m, s, h]: Triple, unsaturated: number): number {
  if (m >= unsaturated - 0.1) return h;
  const spin = (s * Math.sqrt(unsaturated ** 2 - m ** 2)) / (m * Math.sin(s));
  return h > -Math.PI / 3 ? h + spin : h - spin;
}

/** Source: K. Moreland, Diverging Color Maps for Scientific Visualization, ISVC 2009, section 5. */
function diverging(from: Triple, to: Triple): (t: number) => Colour {
  const [a, b] = [mshOf(from), mshOf(to)];
  const turn = Math.abs(a[2] - b[2]);
  const apart = Math.min(turn, 2 * Math.PI - turn) > Math.PI / 3;
  const white: Triple | undefined =
    a[1] > 0.05 && b[1] > 0.05 && apart ? [Math.max(a[0], b[0], 88), 0, 0] : undefined;
  const half = (x: Triple, y: Triple, t: number): Colour => {
    let [p, q] = [x, y];
    if (p[1] < 0.05 && q[1] > 0.05) p = [p[0], p[1], adjustedHue(q, p[0])];
    else if (q[1] < 0.05 && p[1] > 0.05) q = [q[0], q[1], adjustedHue(p, q[0])];
    return rgbOfMsh(mix(p, q, t));
  };
  if (!white) return (t) => half(a, b, t);
  return (t) => (t < 0.5 ? half(a, white, 2 * t) : half(white, b, 2 * t - 1));
}

function hsvOf([r, g, b]: Triple): Triple {
  const value = Math.max(r, g, b);
  const span = value - Math.min(r, g, b);
  if (span === 0) return [0, 0, value];
  const sixth =
    value === r ? (g - b) / span : value === g ? 2 + (b - r) / span : 4 + (r - g) / span;
  return [(sixth / 6 + 1) % 1, span / value, value];
}

function rgbOfHsv([h, s, v]: Triple): Triple {
  const part = (n: number): number => {
    const k = (n + 6 * (((h % 1) + 1) % 1)) % 6;
    return v - v * s * Math.max(0, Math.min(k, 4 - k, 1));
  };
  return [part(5), part(3), part(1)];
}

/** Hue the shorter way round, as ParaView's HSV does with wrapping. */
function hsv(from: Triple, to: Triple): (t: number) => Colour {
  const a = hsvOf(from);
  let b = hsvOf(to);
  if (b[0] - a[0] > 0.5) b = [b[0] - 1, b[1], b[2]];
  else if (a[0] - b[0] > 0.5) b = [b[0] + 1, b[1], b[2]];
  return (t) => linear(rgbOfHsv(mix(a, b, t)));
}

const triple = ([r = 0, g = 0, b = 0]: readonly number[]): Triple => [r, g, b];

/** Linear light on the way from one colour of the display to another; t in [0, 1]. */
export function colourBetween(
  space: ColourSpace,
  from: readonly number[],
  to: readonly number[],
): (t: number) => Colour {
  const [a, b] = [triple(from), triple(to)];
  switch (space) {
    case "Lab": {
      const [x, y] = [labOf(a), labOf(b)];
      return (t) => rgbOfLab(mix(x, y, t));
    }
    case "Diverging":
      return diverging(a, b);
    case "HSV":
      return hsv(a, b);
    case "RGB":
      return (t) => linear(mix(a, b, t));
  }
}
