import { add, cross, dot, length, normalised, subtract, times, type Vec3 } from "./vec3";

/** What is sent: the camera as the protocol spells it. */
export interface CameraPose {
  readonly eye: Vec3;
  readonly center: Vec3;
  readonly up: Vec3;
  readonly orthographic: boolean;
  readonly fovyDegrees: number;
  readonly orthographicHeight: number;
}

/**
 * The camera on a sphere around `target`, a turntable about `axis`; angles in radians, distances
 * in world units. An orthographic camera shows what the perspective one shows at the target's
 * depth, so both share `distance`.
 */
export interface Orbit {
  readonly target: Vec3;
  readonly axis: Vec3;
  readonly yaw: number;
  readonly pitch: number;
  readonly distance: number;
  readonly fovyDegrees: number;
  readonly orthographic: boolean;
}

export interface Bounds {
  readonly min: Vec3;
  readonly max: Vec3;
}

/** A position in CSS pixels from the middle of the picture, y down; height of the picture. */
export interface ScreenPoint {
  readonly x: number;
  readonly y: number;
}

const kDefaultFovyDegrees = 35;

/** Two directions that span the turntable's plane; with `axis` they are right-handed. */
function turntable(axis: Vec3): [Vec3, Vec3] {
  const size = axis.map(Math.abs) as unknown as Vec3;
  const dominant = size[2] >= size[0] && size[2] >= size[1] ? 2 : size[1] >= size[0] ? 1 : 0;
  const next = (dominant + 1) % 3;
  const helper: Vec3 = [next === 0 ? 1 : 0, next === 1 ? 1 : 0, next === 2 ? 1 : 0];
  const first = normalised(subtract(helper, times(axis, dot(helper, axis))));
  return [first, cross(axis, first)];
}

/** From the target towards the eye, up on the screen, and right on the screen; unit length. */
export function frameOf(orbit: Orbit): { toEye: Vec3; up: Vec3; right: Vec3 } {
  const [first, second] = turntable(orbit.axis);
  const level = add(times(first, Math.cos(orbit.yaw)), times(second, Math.sin(orbit.yaw)));
  const sin = Math.sin(orbit.pitch);
  const cos = Math.cos(orbit.pitch);
  const toEye = add(times(level, cos), times(orbit.axis, sin));
  const up = add(times(level, -sin), times(orbit.axis, cos));
  return { toEye, up, right: cross(up, toEye) };
}

const halfFov = (orbit: Orbit): number => (orbit.fovyDegrees * Math.PI) / 360;

/** World units that the picture's height covers at the target. */
export function heightAtTarget(orbit: Orbit): number {
  return 2 * orbit.distance * Math.tan(halfFov(orbit));
}

/** The camera at its distance in the direction `toEye` from the target, a turntable about `axis`. */
export function seenFrom(orbit: Orbit, toEye: Vec3, axis: Vec3): Orbit {
  const [first, second] = turntable(axis);
  const level = Math.hypot(dot(toEye, first), dot(toEye, second));
  return {
    ...orbit,
    axis,
    yaw: level > 1e-9 ? Math.atan2(dot(toEye, second), dot(toEye, first)) : -Math.PI / 2,
    pitch: Math.atan2(dot(toEye, axis), level),
  };
}

/** Reads a pose; its `up` becomes the turntable's axis. */
export function orbitFrom(pose: CameraPose): Orbit {
  const axis = normalised(pose.up);
  const [first, second] = turntable(axis);
  const offset = subtract(pose.eye, pose.center);
  const away = normalised(offset, first);
  const valid = pose.fovyDegrees > 0 && pose.fovyDegrees < 180;
  const fovyDegrees = valid ? pose.fovyDegrees : kDefaultFovyDegrees;
  const tangent = Math.tan((fovyDegrees * Math.PI) / 360);
  const flat = pose.orthographic && pose.orthographicHeight > 0;
  return {
    target: pose.center,
    axis,
    yaw: Math.atan2(dot(away, second), dot(away, first)),
    pitch: Math.asin(Math.max(-1, Math.min(1, dot(away, axis)))),
    distance: flat ? pose.orthographicHeight / (2 * tangent) : length(offset) || 1,
    fovyDegrees,
    orthographic: pose.orthographic,
  };
}

/** The pose to send. An orthographic eye stands outside `bounds`, or it would cut into them. */
export function poseFrom(orbit: Orbit, bounds?: Bounds): CameraPose {
  const { toEye, up } = frameOf(orbit);
  let away = orbit.distance;
  if (orbit.orthographic && bounds) {
    const radius = length(subtract(bounds.max, bounds.min)) / 2;
    const middle = times(add(bounds.min, bounds.max), 0.5);
    away = Math.max(away, radius * 1.5 + length(subtract(orbit.target, middle)));
  }
  return {
    eye: add(orbit.target, times(toEye, away)),
    center: orbit.target,
    up,
    orthographic: orbit.orthographic,
    fovyDegrees: orbit.fovyDegrees,
    orthographicHeight: heightAtTarget(orbit),
  };
}

/** Turns by a drag of (dx, dy) CSS pixels; the poles can be reached and not crossed. */
export function dragged(orbit: Orbit, dx: number, dy: number, radiansPerPixel: number): Orbit {
  const limit = Math.PI / 2;
  const pitch = orbit.pitch + dy * radiansPerPixel;
  return {
    ...orbit,
    yaw: orbit.yaw - dx * radiansPerPixel,
    pitch: Math.max(-limit, Math.min(limit, pitch)),
  };
}

/** Moves the target with the hand: what lay under it at the target's depth stays under it. */
export function panned(orbit: Orbit, dx: number, dy: number, heightPixels: number): Orbit {
  const { up, right } = frameOf(orbit);
  const unit = heightAtTarget(orbit) / heightPixels;
  const shift = add(times(right, -dx * unit), times(up, dy * unit));
  return { ...orbit, target: add(orbit.target, shift) };
}

/** Distance times `factor`; what lies under `at` at the target's depth stays under it. */
export function dollied(
  orbit: Orbit,
  factor: number,
  at: ScreenPoint,
  heightPixels: number,
): Orbit {
  const moved = panned(orbit, -at.x * (1 - factor), -at.y * (1 - factor), heightPixels);
  const distance = Math.min(1e30, Math.max(1e-30, orbit.distance * factor));
  return { ...moved, distance };
}

/** All of `bounds` in a picture of `aspect` = width / height, seen from the same side. */
export function fitted(orbit: Orbit, bounds: Bounds, aspect: number): Orbit {
  const radius = length(subtract(bounds.max, bounds.min)) / 2 || 1;
  const vertical = halfFov(orbit);
  const narrow = Math.min(vertical, Math.atan(Math.tan(vertical) * aspect));
  return {
    ...orbit,
    target: times(add(bounds.min, bounds.max), 0.5),
    distance: radius / Math.sin(narrow),
  };
}

/** The coordinate axis, or its opposite, that is nearest to a direction. */
function straightened(direction: Vec3): Vec3 {
  const most = Math.max(...direction.map(Math.abs));
  const at = direction.findIndex((c) => Math.abs(c) === most);
  return alongCoordinate(at, (direction[at] ?? 1) < 0);
}

const alongCoordinate = (axis: number, negative: boolean): Vec3 => {
  const part = (i: number): number => (i === axis ? (negative ? -1 : 1) : 0);
  return [part(0), part(1), part(2)];
};

/**
 * Looks along a coordinate axis from its positive side, or from its negative one; whatever a
 * trackball tilted stands upright again.
 */
export function alongAxis(orbit: Orbit, axis: 0 | 1 | 2, negative: boolean): Orbit {
  return seenFrom(orbit, alongCoordinate(axis, negative), straightened(orbit.axis));
}

export function withOtherProjection(orbit: Orbit): Orbit {
  return { ...orbit, orthographic: !orbit.orthographic };
}
