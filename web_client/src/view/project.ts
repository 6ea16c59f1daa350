import { type Bounds, frameOf, heightAtTarget, type Orbit } from "./camera";
import { add, dot, subtract, times, type Vec3 } from "./vec3";

/** In picture heights from the middle, y down. */
export interface PicturePoint {
  readonly x: number;
  readonly y: number;
}

/** Right, up and away from the eye, in world units; from the target where orthographic. */
type EyePoint = readonly [right: number, up: number, depth: number];

function eyePointOf(orbit: Orbit, point: Vec3): EyePoint {
  const { toEye, up, right } = frameOf(orbit);
  const eye = orbit.orthographic ? orbit.target : add(orbit.target, times(toEye, orbit.distance));
  const offset = subtract(point, eye);
  return [dot(offset, right), dot(offset, up), -dot(offset, toEye)];
}

const heightAt = (orbit: Orbit, depth: number): number =>
  orbit.orthographic ? heightAtTarget(orbit) : (heightAtTarget(orbit) * depth) / orbit.distance;

function onPicture(orbit: Orbit, [right, up, depth]: EyePoint): PicturePoint {
  const height = heightAt(orbit, depth);
  return { x: right / height, y: -up / height };
}

/** Where a world point falls; undefined behind the eye. */
export function projected(orbit: Orbit, point: Vec3): PicturePoint | undefined {
  const at = eyePointOf(orbit, point);
  return orbit.orthographic || at[2] > 0 ? onPicture(orbit, at) : undefined;
}

/** An edge of a box in the picture; `hidden` behind the box's own faces. */
export interface Edge {
  readonly from: PicturePoint;
  readonly to: PicturePoint;
  readonly hidden: boolean;
}

/** The part of a segment that lies in front of the eye, by a thousandth of the distance. */
function inFront(orbit: Orbit, a: EyePoint, b: EyePoint): [EyePoint, EyePoint] | undefined {
  const near = orbit.distance / 1000;
  if (orbit.orthographic || (a[2] >= near && b[2] >= near)) return [a, b];
  if (a[2] < near && b[2] < near) return undefined;
  const t = (near - a[2]) / (b[2] - a[2]);
  const cut: EyePoint = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), near];
  return a[2] < near ? [cut, b] : [a, cut];
}

/** Faces of `bounds` that are turned to the eye: [low, high] along each axis. */
function facesSeen(orbit: Orbit, { min, max }: Bounds): readonly (readonly [boolean, boolean])[] {
  const { toEye } = frameOf(orbit);
  const eye = add(orbit.target, times(toEye, orbit.distance));
  return ([0, 1, 2] as const).map((i) =>
    orbit.orthographic ? [toEye[i] < 0, toEye[i] > 0] : [eye[i] < min[i], eye[i] > max[i]],
  );
}

/** The twelve edges of `bounds`, less what lies behind the eye. */
export function boxEdges(orbit: Orbit, bounds: Bounds): Edge[] {
  const seen = facesSeen(orbit, bounds);
  const outside = seen.some(([low, high]) => low || high);
  const corner = (high: readonly number[]): EyePoint => {
    const part = (i: 0 | 1 | 2): number => (high[i] ? bounds.max : bounds.min)[i];
    return eyePointOf(orbit, [part(0), part(1), part(2)]);
  };
  const edges: Edge[] = [];
  for (const axis of [0, 1, 2]) {
    const [first, second] = [(axis + 1) % 3, (axis + 2) % 3] as const;
    for (const a of [0, 1] as const) {
      for (const b of [0, 1] as const) {
        const ends = [0, 1].map((end) => {
          const high = [0, 0, 0];
          high[axis] = end;
          high[first] = a;
          high[second] = b;
          return corner(high);
        });
        const part = ends[0] && ends[1] && inFront(orbit, ends[0], ends[1]);
        if (!part) continue;
        const hidden = outside && !seen[first]?.[a] && !seen[second]?.[b];
        edges.push({ from: onPicture(orbit, part[0]), to: onPicture(orbit, part[1]), hidden });
      }
    }
  }
  return edges;
}
