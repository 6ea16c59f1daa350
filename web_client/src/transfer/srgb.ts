/** Linear RGB, 1 is the display's white. Source of the curve: IEC 61966-2-1. */
export interface Colour {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

const clamp01 = (x: number): number => Math.min(1, Math.max(0, x));

/** One linear component to the display's encoding; values outside [0, 1] are clamped. */
export function encodeSrgb(linear: number): number {
  const x = clamp01(linear);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/** The inverse of encodeSrgb on [0, 1]. */
export function decodeSrgb(encoded: number): number {
  const x = clamp01(encoded);
  return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
}

const byte = (linear: number): number => Math.round(255 * encodeSrgb(linear));

/** "#rrggbb", as `<input type="color">` and CSS read it. */
export function toHex(colour: Colour): string {
  const digits = [colour.r, colour.g, colour.b].map((c) => byte(c).toString(16).padStart(2, "0"));
  return `#${digits.join("")}`;
}

/** Reads "#rrggbb"; anything else gives undefined. */
export function fromHex(hex: string): Colour | undefined {
  const match = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(hex.trim());
  if (!match) return undefined;
  const part = (i: number): number => decodeSrgb(Number.parseInt(match[i] ?? "0", 16) / 255);
  return { r: part(1), g: part(2), b: part(3) };
}

/** The straight line between two colours in linear light; t in [0, 1]. */
export function mixColour(a: Colour, b: Colour, t: number): Colour {
  return { r: a.r + t * (b.r - a.r), g: a.g + t * (b.g - a.g), b: a.b + t * (b.b - a.b) };
}
