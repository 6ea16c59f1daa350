import type { Bounds } from "./camera";
import { add, cross, dot, subtract, times, type Vec3 } from "./vec3";

/** The points where dot(normal, p) = offset; `normal` need not be of unit length. */
export interface Plane {
  readonly normal: Vec3;
  readonly offset: number;
}

const at = ({ min, max }: Bounds, i: number): Vec3 => [
  i & 1 ? max[0] : min[0],
  i & 2 ? max[1] : min[1],
  i & 4 ? max[2] : min[2],
];

/** Pairs of corners of a box, by their numbers in binary. */
const kEdges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((corner) =>
  [1, 2, 4].filter((bit) => !(corner & bit)).map((bit) => [corner, corner | bit] as const),
);

/** The middle of a box, moved along the normal into the plane: where the plane's handle is. */
export function middleOf({ normal, offset }: Plane, { min, max }: Bounds): Vec3 {
  const middle = times(add(min, max), 0.5);
  return add(middle, times(normal, (offset - dot(normal, middle)) / dot(normal, normal)));
}

/** The corners, in order, of the polygon in which a plane cuts a box; empty where it misses it. */
export function planeOutline(plane: Plane, bounds: Bounds): Vec3[] {
  const height = (p: Vec3): number => dot(plane.normal, p) - plane.offset;
  const corners = kEdges.flatMap(([i, j]) => {
    const [a, b] = [at(bounds, i), at(bounds, j)];
    const [from, to] = [height(a), height(b)];
    if (from === to || from * to > 0) return [];
    return [add(a, times(subtract(b, a), from / (from - to)))];
  });
  if (corners.length < 3) return [];
  const middle = times(corners.reduce(add), 1 / corners.length);
  const first = subtract(corners[0] ?? middle, middle);
  const second = cross(plane.normal, first);
  const angle = (p: Vec3): number => {
    const offset = subtract(p, middle);
    return Math.atan2(
      dot(offset, second) / Math.sqrt(dot(plane.normal, plane.normal)),
      dot(offset, first),
    );
  };
  const sorted = corners.sort((a, b) => angle(a) - angle(b));
  const same = (a: Vec3, b: Vec3 | undefined): boolean =>
    !!b && a.every((c, i) => Math.abs(c - (b[i] ?? 0)) <= 1e-12 * Math.max(1, Math.abs(c)));
  const distinct = sorted.filter((p, i) => !same(p, sorted.at(i - 1)));
  return distinct.length < 3 ? [] : distinct;
}

/** The least and the largest offset at which a plane with this normal meets a box. */
export function offsetRange(normal: Vec3, bounds: Bounds): [number, number] {
  const offsets = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => dot(normal, at(bounds, i)));
  return [Math.min(...offsets), Math.max(...offsets)];
}
