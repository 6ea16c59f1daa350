import { create } from "@bufbuild/protobuf";
import {
  type CrossSections,
  CrossSectionsSchema,
  type Layer,
  type Light,
  LightSchema,
  RayModel,
} from "../net/gen/volcast/v1/scene_pb";
import { DatasetKind } from "../net/gen/volcast/v1/session_pb";
import type { Bounds } from "../view/camera";
import type { Vec3 } from "../view/vec3";
import { changeLayer } from "./actions";
import type { AppState } from "./app_state";
import type { AxisIndex } from "./clip_planes";

export const isVolume = (state: AppState): boolean =>
  state.dataset.value?.kind === DatasetKind.VOLUME;

export const isAbsorbing = (layer: Layer): boolean =>
  layer.model === RayModel.VOLUME || layer.model === RayModel.UNSPECIFIED;

/** The server's own values of what a light leaves out. */
const kUsualLight = { ambient: 0.3, diffuse: 0.7, specular: 0.2, exponent: 32 } as const;

/** Light needs one gradient and colours that do not come from code. */
export function canBeLit(layer: Layer): boolean {
  return isAbsorbing(layer) && layer.channels.length === 0 && !layer.shader?.code;
}

export type LightNumbers = { -readonly [K in keyof typeof kUsualLight]: number };

export function lightNumbers(light: Light): LightNumbers {
  return {
    ambient: light.ambient ?? kUsualLight.ambient,
    diffuse: light.diffuse ?? kUsualLight.diffuse,
    specular: light.specular ?? kUsualLight.specular,
    exponent: light.exponent ?? kUsualLight.exponent,
  };
}

export function switchLight(state: AppState, on: boolean): void {
  changeLayer(state, { light: on ? create(LightSchema, kUsualLight) : undefined });
}

export function changeLight(
  state: AppState,
  part: Partial<LightNumbers & Pick<Light, "position">>,
  gesture?: string,
): void {
  const light = state.layer.value?.light;
  if (light) changeLayer(state, { light: create(LightSchema, { ...light, ...part }) }, gesture);
}

const message = ([x, y, z]: Vec3): NonNullable<Light["position"]> => ({
  $typeName: "volcast.v1.Vec3",
  x,
  y,
  z,
});

const withAxis = (point: Vec3, axis: AxisIndex, position: number): Vec3 => [
  axis === 0 ? position : point[0],
  axis === 1 ? position : point[1],
  axis === 2 ? position : point[2],
];

/** Lights from a point outside of the data's upper corner, or from the eye. */
export function placeLight(state: AppState, from: "eye" | "point"): void {
  const bounds = state.bounds.value;
  if (from === "eye") changeLight(state, { position: undefined });
  else if (bounds) {
    const { min, max } = bounds;
    const outside = (axis: AxisIndex): number => max[axis] + (max[axis] - min[axis]) / 2;
    changeLight(state, { position: message([outside(0), outside(1), outside(2)]) });
  }
}

export function moveLight(state: AppState, axis: AxisIndex, position: number): void {
  const at = state.layer.value?.light?.position;
  if (at) changeLight(state, { position: message(withAxis([at.x, at.y, at.z], axis, position)) });
}

/** Three planes across the axes. */
export interface Sections {
  readonly point: Vec3;
  readonly shown: readonly [boolean, boolean, boolean];
}

export function sectionsOf(sections: CrossSections | undefined, { min, max }: Bounds): Sections {
  const at = sections?.point;
  const middle = (axis: AxisIndex): number => (min[axis] + max[axis]) / 2;
  return {
    point: at ? [at.x, at.y, at.z] : [middle(0), middle(1), middle(2)],
    shown: [!sections?.hideFirst, !sections?.hideSecond, !sections?.hideThird],
  };
}

/** Moves the plane across an axis, shows or hides it. */
export function changeSection(
  state: AppState,
  axis: AxisIndex,
  part: { readonly position?: number; readonly shown?: boolean },
  gesture?: string,
): void {
  const bounds = state.bounds.value;
  const before = state.layer.value?.crossSections;
  if (!bounds) return;
  const { point, shown } = sectionsOf(before, bounds);
  const hidden = (i: AxisIndex): boolean => !(i === axis ? (part.shown ?? shown[i]) : shown[i]);
  const crossSections = create(CrossSectionsSchema, {
    point:
      part.position === undefined ? before?.point : message(withAxis(point, axis, part.position)),
    hideFirst: hidden(0),
    hideSecond: hidden(1),
    hideThird: hidden(2),
  });
  changeLayer(state, { crossSections }, gesture);
}

/** How the distance of samples is said: by the server, in world units, as a count over the depth. */
export type StepKind = "usual" | "length" | "count";

export function stepKindOf({ depthSamples, stepWorld }: Layer): StepKind {
  if (depthSamples > 0) return "count";
  return stepWorld > 0 ? "length" : "usual";
}

const kUsualSamples = 64;

/** Another way to say the distance of samples, with a value to start from. */
export function chooseStep(state: AppState, kind: StepKind): void {
  const { dataset, bounds } = state;
  const voxels = dataset.value?.voxels ?? [];
  const box = bounds.value;
  const axes: readonly AxisIndex[] = [0, 1, 2];
  const spacings = axes.flatMap((a) => {
    const intervals = (voxels[a] ?? 1) - 1;
    return box && intervals > 0 ? [(box.max[a] - box.min[a]) / intervals] : [];
  });
  const stepWorld = kind === "length" && spacings.length > 0 ? Math.min(...spacings) / 2 : 0;
  changeLayer(state, { stepWorld, depthSamples: kind === "count" ? kUsualSamples : 0 });
}

/** Samples in the middle of their steps, or anywhere in them: by a seed, which tells pictures apart. */
export function switchJitter(state: AppState, on: boolean): void {
  changeLayer(state, { jitter: on ? 1 : undefined });
}

const kMostSeed = 2 ** 32 - 1;

export function changeSeed(state: AppState, seed: number): void {
  changeLayer(state, { jitter: Math.round(Math.min(kMostSeed, Math.max(0, seed))) });
}

/** Slices blend what rays gather; code runs where rays march, and so do several channels. */
export function canBeSliced(layer: Layer): boolean {
  const opaque = layer.model === RayModel.ISOSURFACE || layer.model === RayModel.CROSS_SECTIONS;
  return !opaque && layer.channels.length === 0 && !layer.shader?.code;
}
