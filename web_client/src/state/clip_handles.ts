import { create } from "@bufbuild/protobuf";
import { type ClipPlane, ClipPlaneSchema } from "../net/gen/volcast/v1/scene_pb";
import { type Bounds, heightAtTarget, type Orbit } from "../view/camera";
import { middleOf, offsetRange, type Plane } from "../view/plane_outline";
import type { PicturePoint } from "../view/project";
import { placeOnLine, rayThrough } from "../view/ray";
import { length, times, type Vec3 } from "../view/vec3";
import { changeScene } from "./actions";
import type { AppState } from "./app_state";
import { type AxisIndex, axisPlaneOf, kAxisNames, planeMessage } from "./clip_planes";

export function planeOf({ normal, offset }: ClipPlane): Plane {
  return { normal: [normal?.x ?? 0, normal?.y ?? 0, normal?.z ?? 0], offset };
}

/** A clip plane as what a hand holds: a place between two ends along a direction. */
export interface Handle {
  readonly name: string;
  /** Of unit length; along the axis that the plane stands across, else along its normal. */
  readonly along: Vec3;
  /** World units along that direction. */
  readonly place: number;
  readonly low: number;
  readonly high: number;
  /** The world point that `place` is at. */
  readonly at: Vec3;
  readonly plane: Plane;
}

export function handleOf(message: ClipPlane, index: number, bounds: Bounds): Handle | undefined {
  const plane = planeOf(message);
  const size = length(plane.normal);
  if (!(size > 0)) return undefined;
  const axis = axisPlaneOf(message);
  const sign = axis?.below ? -1 : 1;
  const along = times(plane.normal, sign / size);
  const [low, high] = offsetRange(along, bounds);
  const place = axis ? axis.position : plane.offset / size;
  const across = axis ? kAxisNames[axis.axis] : "oblique";
  return {
    name: `Clip plane ${index + 1}, ${across}`,
    along,
    place,
    low,
    high,
    at: middleOf(plane, bounds),
    plane,
  };
}

/** Moves a plane to a place along its handle's direction, kept in the data's bounds. */
export function moveHandle(state: AppState, index: number, place: number): void {
  const planes = state.scene.value?.clipPlanes ?? [];
  const bounds = state.bounds.value;
  const message = planes[index];
  const handle = message && bounds && handleOf(message, index, bounds);
  if (!message || !handle) return;
  const to = Math.min(handle.high, Math.max(handle.low, place));
  const axis = axisPlaneOf(message);
  const size = length(handle.plane.normal);
  const moved = axis
    ? planeMessage({ ...axis, position: to })
    : create(ClipPlaneSchema, { ...message, offset: to * size });
  const clipPlanes = planes.map((plane, i) => (i === index ? moved : plane));
  changeScene(state, { clipPlanes }, `clip handle ${index}`);
}

export function removePlane(state: AppState, index: number): void {
  const planes = state.scene.value?.clipPlanes ?? [];
  changeScene(state, { clipPlanes: planes.filter((_, i) => i !== index) });
}

/** Where a handle is taken: what moves it, whatever part of it was taken. */
export interface Grip {
  readonly handle: Handle;
  readonly orbit: Orbit;
  readonly from: PicturePoint;
}

/** The place of a handle that was taken by `grip` and is now held at `to`. */
export function draggedTo({ handle, orbit, from }: Grip, to: PicturePoint): number {
  const { at, along, place } = handle;
  const before = placeOnLine(rayThrough(orbit, from), at, along);
  const after = placeOnLine(rayThrough(orbit, to), at, along);
  if (before !== undefined && after !== undefined) return place + after - before;
  // One looks along the direction: up is forward.
  return place + (from.y - to.y) * heightAtTarget(orbit);
}

const kKeySteps: Readonly<Record<string, number>> = {
  ArrowRight: 0.01,
  ArrowUp: 0.01,
  ArrowLeft: -0.01,
  ArrowDown: -0.01,
  PageUp: 0.1,
  PageDown: -0.1,
};

/** Where a key takes a handle; undefined for a key that means nothing to it. */
export function placeByKey(
  { place, low, high }: Handle,
  key: string,
  fine: boolean,
): number | undefined {
  if (key === "Home") return low;
  if (key === "End") return high;
  const step = kKeySteps[key];
  return step === undefined ? undefined : place + step * (fine ? 0.1 : 1) * (high - low);
}

const kInset = 0.05;
const kAxes: readonly AxisIndex[] = [0, 1, 2];

/** Six planes that leave a box of the data, a little smaller than all of it. */
export function boxPlanes({ min, max }: Bounds): ClipPlane[] {
  return kAxes.flatMap((axis) => {
    const inset = kInset * (max[axis] - min[axis]);
    return [
      planeMessage({ axis, position: min[axis] + inset, below: false }),
      planeMessage({ axis, position: max[axis] - inset, below: true }),
    ];
  });
}
