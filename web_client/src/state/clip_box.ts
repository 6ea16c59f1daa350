import type { ClipPlane } from "../net/gen/volcast/v1/scene_pb";
import { type Bounds, frameOf, type Orbit } from "../view/camera";
import type { PicturePoint } from "../view/project";
import { rayThrough } from "../view/ray";
import { add, dot, subtract, times, type Vec3 } from "../view/vec3";
import { changeScene } from "./actions";
import type { AppState } from "./app_state";
import { type AxisIndex, axisPlaneOf, planeMessage } from "./clip_planes";

const kAxes: readonly AxisIndex[] = [0, 1, 2];

/** What of the data the planes leave, where they are the six faces of a box; world units. */
export function boxOf(planes: readonly ClipPlane[]): Bounds | undefined {
  const known = planes.map(axisPlaneOf);
  const face = (axis: AxisIndex, below: boolean): number => {
    const found = known.filter((plane) => plane?.axis === axis && plane.below === below);
    return found.length === 1 ? (found[0]?.position ?? Number.NaN) : Number.NaN;
  };
  const corner = (below: boolean): Vec3 => [face(0, below), face(1, below), face(2, below)];
  const [min, max] = [corner(false), corner(true)];
  return kAxes.every((axis) => max[axis] >= min[axis]) ? { min, max } : undefined;
}

export const middleOfBox = ({ min, max }: Bounds): Vec3 => times(add(min, max), 0.5);

/** Moves the box of planes to where `box` would be after `by`, kept in the data's bounds. */
export function moveBox(state: AppState, box: Bounds, by: Vec3): void {
  const bounds = state.bounds.value;
  const planes = state.scene.value?.clipPlanes ?? [];
  if (!bounds || !boxOf(planes)) return;
  const moves = kAxes.map((axis) => {
    const [back, forth] = [bounds.min[axis] - box.min[axis], bounds.max[axis] - box.max[axis]];
    return Math.min(Math.max(by[axis], Math.min(back, 0)), Math.max(forth, 0));
  });
  const clipPlanes = planes.map((plane) => {
    const known = axisPlaneOf(plane);
    if (!known) return plane;
    const { axis, below } = known;
    const position = (below ? box.max : box.min)[axis] + (moves[axis] ?? 0);
    return planeMessage({ axis, below, position });
  });
  changeScene(state, { clipPlanes }, "clip box");
}

/** Where a box is taken by its middle. */
export interface BoxGrip {
  readonly box: Bounds;
  readonly orbit: Orbit;
  readonly from: PicturePoint;
}

/** How far a box that was taken by `grip` has come when it is held at `to`: across the view. */
export function boxDraggedBy({ box, orbit, from }: BoxGrip, to: PicturePoint): Vec3 {
  const { toEye } = frameOf(orbit);
  const middle = middleOfBox(box);
  const across = (at: PicturePoint): Vec3 => {
    const { origin, direction } = rayThrough(orbit, at);
    const far = dot(subtract(middle, origin), toEye) / dot(direction, toEye);
    return add(origin, times(direction, far));
  };
  return subtract(across(to), across(from));
}

const kKeys: Readonly<Record<string, readonly [towards: "right" | "up" | "away", steps: number]>> =
  {
    ArrowRight: ["right", 1],
    ArrowLeft: ["right", -1],
    ArrowUp: ["up", 1],
    ArrowDown: ["up", -1],
    PageUp: ["away", 1],
    PageDown: ["away", -1],
  };

/**
 * How far a key moves a box: a hundredth of the data, a tenth of that where `fine`, along the axis
 * that looks most like the key's way. Undefined for a key that means nothing to it.
 */
export function boxMoveByKey(
  orbit: Orbit,
  bounds: Bounds,
  key: string,
  fine: boolean,
): Vec3 | undefined {
  const meant = kKeys[key];
  if (!meant) return undefined;
  const [towards, steps] = meant;
  const { right, up, toEye } = frameOf(orbit);
  const ways = { right, up, away: times(toEye, -1) };
  const free = new Set(kAxes);
  const take = (way: Vec3): AxisIndex => {
    const axis = [...free].reduce((a, b) => (Math.abs(way[b]) > Math.abs(way[a]) ? b : a));
    free.delete(axis);
    return axis;
  };
  // Three keys, three axes: none of them is out of reach.
  const axes = { right: take(ways.right), up: take(ways.up), away: take(ways.away) };
  const axis = axes[towards];
  const size = 0.01 * (fine ? 0.1 : 1) * (bounds.max[axis] - bounds.min[axis]);
  const along = (i: AxisIndex): number =>
    i === axis ? steps * size * (ways[towards][axis] < 0 ? -1 : 1) : 0;
  return [along(0), along(1), along(2)];
}
