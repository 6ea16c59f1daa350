/**
 * Extinction is per world unit, which nobody can picture. People see opacity: the share of light
 * that a length of `referenceLength` world units takes away, a = 1 - exp(-sigma L). Both ways are
 * written with expm1 and log1p, so that thin matter keeps its digits.
 */
export function opacityFromExtinction(extinction: number, referenceLength: number): number {
  return -Math.expm1(-extinction * referenceLength);
}

/** The inverse; opacity in [0, 1), 1 would need infinite extinction. */
export function extinctionFromOpacity(opacity: number, referenceLength: number): number {
  return -Math.log1p(-opacity) / referenceLength;
}

/** The most that the editor draws: beyond it a reference length lets less than 0.1 % through. */
export const kMaxDrawnOpacity = 0.999;

/** A tenth of the data's diagonal, in world units; 1 where there is no extent. */
export function referenceLengthOf(diagonalWorld: number): number {
  return diagonalWorld > 0 && Number.isFinite(diagonalWorld) ? diagonalWorld / 10 : 1;
}
