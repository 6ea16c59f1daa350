import { type SmoothCurve, withCurvePointAt, withoutCurvePoint } from "../transfer/smooth_curve";
import type { Colour } from "../transfer/srgb";
import {
  isEnd,
  type TransferFunction,
  withColour,
  withoutPoint,
  withPointAt,
} from "../transfer/transfer_function";
import { axisOfSlot, changeApart, changeMap, mapEditOf } from "./actions";
import type { AppState } from "./app_state";
import { type Slot, usesColours, usesExtinction } from "./models";

/** Points that are edited by themselves: those of a map, or of its colours or opacities alone. */
export interface MapTarget {
  readonly part: "map" | "colours" | "opacities";
  /** What people call one of them. */
  readonly name: string;
  readonly points: TransferFunction;
  readonly showsColours: boolean;
  readonly showsOpacity: boolean;
}

/** Whether both parts of a map play a part, so that they can be edited apart. */
export function canBeApart(state: AppState, slot: Slot): boolean {
  const layer = state.layer.value;
  return usesColours(layer, slot) && usesExtinction(layer, slot);
}

/** What of a map is edited: all of it, or its two parts. */
export function targetsOf(state: AppState, slot: Slot): readonly MapTarget[] {
  const { map, apart } = mapEditOf(state, slot);
  const layer = state.layer.value;
  const showsColours = usesColours(layer, slot);
  const showsOpacity = usesExtinction(layer, slot);
  if (apart) {
    const { colours, opacities } = apart;
    const targets: MapTarget[] = [
      {
        part: "opacities",
        name: "Opacity point",
        points: opacities,
        showsColours: false,
        showsOpacity: true,
      },
      {
        part: "colours",
        name: "Colour point",
        points: colours,
        showsColours: true,
        showsOpacity: false,
      },
    ];
    return targets.filter((t) => (t.showsOpacity ? showsOpacity : showsColours));
  }
  return [{ part: "map", name: "Point", points: map, showsColours, showsOpacity }];
}

/** The points as they are now: signals may be ahead of what was drawn. */
export function pointsOf(state: AppState, slot: Slot, part: MapTarget["part"]): TransferFunction {
  const { map, apart } = mapEditOf(state, slot);
  return part === "map" ? map : (apart?.[part] ?? map);
}

export function changePoints(
  state: AppState,
  slot: Slot,
  part: MapTarget["part"],
  points: TransferFunction,
  gesture?: string,
): void {
  if (points === pointsOf(state, slot, part)) return;
  if (part === "map") changeMap(state, points, gesture, slot);
  else changeApart(state, { [part]: points }, gesture, slot);
}

/** The curve that the points of a part are of; undefined where lines are straight between them. */
function curveOf(state: AppState, slot: Slot, part: MapTarget["part"]): SmoothCurve | undefined {
  const { smooth, apart } = mapEditOf(state, slot);
  if (part !== "opacities" || smooth === undefined || !apart) return undefined;
  const { opacities, knots } = apart;
  return { opacities, knots, distance: smooth, axis: axisOfSlot(state, slot) };
}

/** Adds a point that changes nothing until it is moved, but for its `colour`; returns its index. */
export function addPoint(
  state: AppState,
  slot: Slot,
  part: MapTarget["part"],
  value: number,
  colour?: Colour,
): number {
  const curve = curveOf(state, slot, part);
  if (curve) {
    const { opacities, knots, index } = withCurvePointAt(curve, value);
    if (opacities.length > curve.opacities.length) {
      changeApart(state, { opacities, knots }, undefined, slot);
    }
    return index;
  }
  const points = pointsOf(state, slot, part);
  const { map, index } = withPointAt(points, value, axisOfSlot(state, slot).along);
  changePoints(state, slot, part, colour ? withColour(map, index, colour) : map);
  return index;
}

/** Removes a point that is no end. */
export function removePoint(
  state: AppState,
  slot: Slot,
  part: MapTarget["part"],
  index: number,
): void {
  const points = pointsOf(state, slot, part);
  if (isEnd(points, index)) return;
  const curve = curveOf(state, slot, part);
  if (curve) {
    const { opacities, knots } = withoutCurvePoint(curve, index);
    changeApart(state, { opacities, knots }, undefined, slot);
  } else {
    changePoints(state, slot, part, withoutPoint(points, index));
  }
}
