import { create } from "@bufbuild/protobuf";
import { type ClipPlane, ClipPlaneSchema } from "../net/gen/volcast/v1/scene_pb";
import type { Bounds } from "../view/camera";

export type AxisIndex = 0 | 1 | 2;

export const kAxisNames = ["X", "Y", "Z"] as const;
export const kMostPlanes = 6;

/** A plane across an axis: kept is what lies above `position`, or below it where `below`. */
export interface AxisPlane {
  readonly axis: AxisIndex;
  readonly position: number;
  readonly below: boolean;
}

/** Undefined for a plane that no axis stands on; such come from saved scenes. */
export function axisPlaneOf({ normal, offset }: ClipPlane): AxisPlane | undefined {
  const parts = [normal?.x ?? 0, normal?.y ?? 0, normal?.z ?? 0];
  const along = parts.flatMap((x, i) => (x === 0 ? [] : [i as AxisIndex]));
  const [axis] = along;
  if (axis === undefined || along.length > 1) return undefined;
  const length = parts[axis] ?? 1;
  const position = offset / length;
  return { axis, position: position === 0 ? 0 : position, below: length < 0 };
}

export function planeMessage({ axis, position, below }: AxisPlane): ClipPlane {
  const sign = below ? -1 : 1;
  const at = (i: number): number => (i === axis ? sign : 0);
  const normal = { x: at(0), y: at(1), z: at(2) };
  return create(ClipPlaneSchema, { normal, offset: position === 0 ? 0 : sign * position });
}

/** Through the middle of the data, across the first axis that has no plane yet. */
export function nextPlane(planes: readonly ClipPlane[], bounds: Bounds): AxisPlane {
  const taken = planes.map((p) => axisPlaneOf(p)?.axis);
  const axes: readonly AxisIndex[] = [0, 1, 2];
  const axis = axes.find((a) => !taken.includes(a)) ?? 0;
  return { axis, position: (bounds.min[axis] + bounds.max[axis]) / 2, below: true };
}
