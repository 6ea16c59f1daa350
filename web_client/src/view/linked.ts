import type { Orbit } from "./camera";
import { add, subtract, times } from "./vec3";

/**
 * The camera that sees other data as `orbit` sees its own: turned the same way, as much closer or to
 * the side as `orbit` is from `home`. Of equal homes it is `orbit` itself.
 */
export function linkedOrbit(orbit: Orbit, home: Orbit, otherHome: Orbit): Orbit {
  const scale = otherHome.distance / home.distance;
  const apart = subtract(otherHome.target, home.target);
  if (scale === 1 && apart.every((c) => c === 0)) return orbit;
  const aside = times(subtract(orbit.target, home.target), scale);
  return { ...orbit, target: add(otherHome.target, aside), distance: orbit.distance * scale };
}
