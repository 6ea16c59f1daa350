import { frameOf, heightAtTarget, type Orbit } from "./camera";
import { add, times, type Vec3 } from "./vec3";

/** Where to, in picture heights at the target: along the screen and into it. */
export interface Flight {
  readonly right: number;
  readonly up: number;
  readonly forward: number;
}

/** Moves eye and target together. An orthographic camera comes closer by showing less. */
export function flown(orbit: Orbit, { right, up, forward }: Flight): Orbit {
  const frame = frameOf(orbit);
  const unit = heightAtTarget(orbit);
  const aside: Vec3 = add(times(frame.right, right * unit), times(frame.up, up * unit));
  const target = add(orbit.target, aside);
  if (orbit.orthographic)
    return { ...orbit, target, distance: orbit.distance * Math.exp(-forward) };
  return { ...orbit, target: add(target, times(frame.toEye, -forward * unit)) };
}

/** By their place on the keyboard. */
const kKeys: Readonly<Record<string, keyof Flight | `-${keyof Flight}`>> = {
  KeyW: "forward",
  KeyS: "-forward",
  KeyD: "right",
  KeyA: "-right",
  KeyE: "up",
  KeyQ: "-up",
};

export const isFlightKey = (code: string): boolean => code in kKeys;

const kHeightsPerSecond = 0.6;
const kFast = 4;
/** A page that was held up does not jump afterwards. */
const kLongestStepS = 0.1;

/** The way that held keys lead in so many seconds. */
export function flightOf(held: ReadonlySet<string>, fast: boolean, seconds: number): Flight {
  const step = kHeightsPerSecond * (fast ? kFast : 1) * Math.min(seconds, kLongestStepS);
  const sum = { right: 0, up: 0, forward: 0 };
  for (const code of held) {
    const way = kKeys[code];
    if (!way) continue;
    const negative = way.startsWith("-");
    sum[(negative ? way.slice(1) : way) as keyof Flight] += negative ? -step : step;
  }
  return sum;
}
