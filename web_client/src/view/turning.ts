import { dragged, frameOf, type Orbit, seenFrom } from "./camera";
import { add, cross, dot, normalised, subtract, times, type Vec3 } from "./vec3";

/** How hands turn a camera: (dx, dy) in CSS pixels, y down. */
export type Turn = (orbit: Orbit, dx: number, dy: number, radiansPerPixel: number) => Orbit;

/**
 * Turns as if the data were in a ball under the hand: about the target, in any direction, with no
 * axis that stays upright.
 */
export const rolled: Turn = (orbit, dx, dy, radiansPerPixel) => {
  const size = Math.hypot(dx, dy);
  if (size === 0) return orbit;
  const { toEye, up, right } = frameOf(orbit);
  const towards = times(add(times(right, -dx), times(up, dy)), 1 / size);
  const about = cross(toEye, towards);
  const cos = Math.cos(size * radiansPerPixel);
  const sin = Math.sin(size * radiansPerPixel);
  const turned = (v: Vec3): Vec3 => {
    const along = dot(v, about);
    const [eye, side] = [dot(v, toEye), dot(v, towards)];
    const a = times(toEye, eye * cos - side * sin);
    const b = times(towards, eye * sin + side * cos);
    return add(times(about, along), add(a, b));
  };
  // Made upright to each other again, or rounding would grow with every turn.
  const eye = normalised(turned(toEye));
  const above = turned(up);
  return seenFrom(orbit, eye, normalised(subtract(above, times(eye, dot(above, eye)))));
};

/** Looks around from where the eye is: the picture moves with the hand. */
export const looked: Turn = (orbit, dx, dy, radiansPerPixel) => {
  const eye = add(orbit.target, times(frameOf(orbit).toEye, orbit.distance));
  const next = dragged(orbit, -dx, -dy, radiansPerPixel);
  return { ...next, target: subtract(eye, times(frameOf(next).toEye, orbit.distance)) };
};

/** Seen from the same side with `axis` upright. */
export function levelled(orbit: Orbit, axis: Vec3): Orbit {
  return seenFrom(orbit, frameOf(orbit).toEye, axis);
}
