import { create } from "@bufbuild/protobuf";
import {
  type MapState,
  type MapState_Point,
  MapState_PointSchema,
  MapStateSchema,
  type Range,
  RangeSchema,
} from "../net/gen/volcast/v1/scene_pb";
import type {
  ShaderControl,
  ShaderControl_TransferFunction,
} from "../net/gen/volcast/v1/session_pb";
import type { Colour } from "../transfer/srgb";
import { sampleAt, type TransferFunction } from "../transfer/transfer_function";
import type { AppState } from "./app_state";
import { changeControl, controlValue, toDisplay, toLinear } from "./shader_actions";

/** A transferFunction control as it is edited: linear colours, opacities from 0 to 1. */
export interface ControlMap {
  readonly window: { readonly min: number; readonly max: number };
  readonly points: readonly ControlPoint[];
}

export interface ControlPoint {
  readonly value: number;
  readonly colour: Colour;
  readonly opacity: number;
}

/** The server takes no more. */
export const kMostControlPoints = 256;

const pointOf = ({ value, colour, opacity }: MapState_Point): ControlPoint => ({
  value,
  opacity,
  colour: toLinear(colour ?? { r: 1, g: 1, b: 1 }),
});

/** What a control is set to, or declared as. */
export function controlMapOf(
  state: AppState,
  control: ShaderControl,
  declared: ShaderControl_TransferFunction,
): ControlMap {
  const now = controlValue(state, control);
  const set = now.case === "map" ? now.value : undefined;
  const { min, max } = set?.window ?? declared.window ?? { min: 0, max: 1 };
  return { window: { min, max }, points: (set?.points ?? declared.points).map(pointOf) };
}

export function changeControlMap(
  state: AppState,
  name: string,
  declared: ShaderControl_TransferFunction,
  map: ControlMap,
  gesture?: string,
): void {
  const window: Range = create(RangeSchema, map.window);
  const points = map.points.map(({ value, colour, opacity }) =>
    create(MapState_PointSchema, {
      value,
      opacity,
      colour: { $typeName: "volcast.v1.Colour", ...toDisplay(colour) },
    }),
  );
  const { channel } = declared;
  const value: MapState = create(MapStateSchema, { window, points, channel });
  changeControl(state, name, { case: "map", value }, gesture);
}

/** As the code sees it, for drawing: nothing below the first point; `extinction` is the opacity. */
export function asDrawn({ points }: ControlMap): TransferFunction {
  const drawn = points.map(({ value, colour, opacity }) => ({
    value,
    colour,
    extinction: opacity,
  }));
  return drawn[0] ? [{ ...drawn[0], extinction: 0 }, ...drawn] : [];
}

/** Adds a point that changes nothing, in the colour for new ones where there is nothing yet. */
export function withControlPoint(
  map: ControlMap,
  value: number,
  usual: Colour,
): { readonly map: ControlMap; readonly index: number } {
  const { colour, extinction } = sampleAt(asDrawn(map), value);
  const isFirst = map.points.every((p) => p.value > value);
  const point = { value, colour: isFirst ? usual : colour, opacity: isFirst ? 0 : extinction };
  const after = map.points.findIndex((p) => p.value > value);
  const index = after < 0 ? map.points.length : after;
  const points = [...map.points.slice(0, index), point, ...map.points.slice(index)];
  return { map: { ...map, points }, index };
}

/** Changes a point; it stays between its neighbours and in the window. */
export function withControlPart(
  map: ControlMap,
  index: number,
  part: Partial<ControlPoint>,
): ControlMap {
  const point = map.points[index];
  if (!point) return map;
  const low = map.points[index - 1]?.value ?? Math.min(map.window.min, point.value);
  const high = map.points[index + 1]?.value ?? Math.max(map.window.max, point.value);
  const next = { ...point, ...part };
  const within = (x: number, a: number, b: number): number => Math.min(b, Math.max(a, x));
  const kept = {
    ...next,
    value: Number.isFinite(next.value) ? within(next.value, low, high) : point.value,
    opacity: Number.isFinite(next.opacity) ? within(next.opacity, 0, 1) : point.opacity,
  };
  return { ...map, points: map.points.map((p, i) => (i === index ? kept : p)) };
}

export function withoutControlPoint(map: ControlMap, index: number): ControlMap {
  return { ...map, points: map.points.filter((_, i) => i !== index) };
}
