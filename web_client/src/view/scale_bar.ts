import { heightAtTarget, type Orbit } from "./camera";

/** A round length in world units with its size on the screen in CSS pixels. */
export interface ScaleBar {
  readonly length: number;
  readonly pixels: number;
}

/** The longest 1, 2 or 5 times a power of ten that is at most `most`; 0 for nothing. */
export function roundLength(most: number): number {
  if (!(most > 0) || !Number.isFinite(most)) return 0;
  const exponent = Math.floor(Math.log10(most) + 1e-9);
  const ones = [5, 2, 1].find((digit) => Number(`${digit}e${exponent}`) <= most * (1 + 1e-9));
  return Number(`${ones ?? 1}e${exponent}`);
}

/** A length at the target's depth, at most `most` pixels of a picture so many pixels high. */
export function scaleBarOf(orbit: Orbit, heightPixels: number, most: number): ScaleBar {
  const unit = heightAtTarget(orbit) / heightPixels;
  const length = roundLength(most * unit);
  return { length, pixels: length / unit };
}
