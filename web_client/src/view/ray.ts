import { frameOf, heightAtTarget, type Orbit } from "./camera";
import type { PicturePoint } from "./project";
import { add, dot, normalised, subtract, times, type Vec3 } from "./vec3";

/** What a point of the picture looks along; `direction` is of unit length. */
export interface Ray {
  readonly origin: Vec3;
  readonly direction: Vec3;
}

/** The ray through a point of the picture: `project.ts` the other way round. */
export function rayThrough(orbit: Orbit, { x, y }: PicturePoint): Ray {
  const { toEye, up, right } = frameOf(orbit);
  const height = heightAtTarget(orbit);
  const aside = add(times(right, x * height), times(up, -y * height));
  const eye = add(orbit.target, times(toEye, orbit.distance));
  if (orbit.orthographic) return { origin: add(eye, aside), direction: times(toEye, -1) };
  return { origin: eye, direction: normalised(subtract(add(orbit.target, aside), eye)) };
}

/** Below this sine of the angle between them, a ray says nothing about a place on a line. */
const kLeastSine = 0.1;

/**
 * How far along a line through `from` in the unit direction `along` the ray comes nearest to it, in
 * world units; undefined where one looks along the line.
 */
export function placeOnLine(ray: Ray, from: Vec3, along: Vec3): number | undefined {
  const cosine = dot(along, ray.direction);
  const sine2 = 1 - cosine * cosine;
  if (sine2 < kLeastSine * kLeastSine) return undefined;
  const offset = subtract(from, ray.origin);
  return (cosine * dot(offset, ray.direction) - dot(offset, along)) / sine2;
}
