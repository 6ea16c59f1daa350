import type { Orbit } from "../view/camera";
import { levelled } from "../view/turning";
import type { Vec3 } from "../view/vec3";

/** A whole turn about the data's upright axis, in so many pictures. */
export interface TurnWish {
  readonly pictures: number;
  /** A video as browsers make it, or the lossless pictures in an archive. */
  readonly format: "webm" | "png";
}

export interface Recording {
  /** 0 to 1. */
  readonly progress: number;
  stop(): void;
}

export const kFewestPictures = 2;
export const kMostPictures = 720;

export function picturesWithin(count: number): number {
  const whole = Math.round(count);
  return Math.min(kMostPictures, Math.max(kFewestPictures, Number.isFinite(whole) ? whole : 0));
}

/** The cameras of a turn that begins where one is and would end there. */
export function turnOf(start: Orbit, axis: Vec3, pictures: number): Orbit[] {
  const upright = levelled(start, axis);
  const step = (2 * Math.PI) / pictures;
  return Array.from({ length: pictures }, (_, i) => ({ ...upright, yaw: upright.yaw + i * step }));
}
