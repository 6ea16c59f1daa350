import { create } from "@bufbuild/protobuf";
import {
  type Camera,
  CameraSchema,
  Projection,
  type Scale,
  type Scene,
  SceneSchema,
  type TransferFunction as TransferFunctionMessage,
  TransferFunctionSchema,
} from "../net/gen/volcast/v1/scene_pb";
import { bothOf } from "../transfer/apart";
import { axisOf } from "../transfer/scale";
import { smoothed } from "../transfer/smooth_curve";
import { scaled, type TransferFunction, withoutIdlePoints } from "../transfer/transfer_function";
import { type Bounds, type Orbit, orbitFrom, poseFrom } from "../view/camera";
import type { Vec3 } from "../view/vec3";
import type { MapEdit, Maps } from "./app_state";

const message = (v: Vec3) => ({ x: v[0], y: v[1], z: v[2] });
const vector = (v: { x: number; y: number; z: number } | undefined): Vec3 =>
  v ? [v.x, v.y, v.z] : [0, 0, 0];

export function cameraMessage(orbit: Orbit, bounds: Bounds | undefined): Camera {
  const pose = poseFrom(orbit, bounds);
  return create(CameraSchema, {
    eye: message(pose.eye),
    center: message(pose.center),
    up: message(pose.up),
    projection: pose.orthographic ? Projection.ORTHOGRAPHIC : Projection.PERSPECTIVE,
    fovyDegrees: pose.fovyDegrees,
    orthographicHeight: pose.orthographicHeight,
  });
}

export function orbitOf(camera: Camera): Orbit {
  return orbitFrom({
    eye: vector(camera.eye),
    center: vector(camera.center),
    up: vector(camera.up),
    orthographic: camera.projection === Projection.ORTHOGRAPHIC,
    fovyDegrees: camera.fovyDegrees,
    orthographicHeight: camera.orthographicHeight,
  });
}

export function mapMessage(map: TransferFunction): TransferFunctionMessage {
  return create(TransferFunctionSchema, { points: map.map((p) => ({ ...p })) });
}

export function mapOf(message: TransferFunctionMessage | undefined): TransferFunction {
  return (message?.points ?? []).map((p) => ({
    value: p.value,
    colour: { r: p.colour?.r ?? 0, g: p.colour?.g ?? 0, b: p.colour?.b ?? 0 },
    extinction: p.extinction,
  }));
}

/** What is drawn of an edited map: its curve, with extinction times the density. */
export function drawnFrom(edit: MapEdit, scale: Scale | undefined): TransferFunction {
  const { map, density, smooth, apart } = edit;
  const axis = axisOf(scale, map[0]?.value ?? 0, map[map.length - 1]?.value ?? 0);
  const shown = smooth
    ? smoothed(apart ?? bothOf(map), smooth, axis)
    : withoutIdlePoints(map, axis.along);
  return scaled(shown, density);
}

const drawnMessage = (
  edit: MapEdit | undefined,
  scale: Scale | undefined,
): TransferFunctionMessage | undefined =>
  edit && edit.map.length > 0 ? mapMessage(drawnFrom(edit, scale)) : undefined;

/** The whole scene as it is sent: `base` with this camera, and these maps in its first layer. */
export function sceneMessage(
  base: Scene,
  orbit: Orbit,
  bounds: Bounds | undefined,
  edit: Maps,
): Scene {
  const first = base.layers[0];
  const transferFunction = drawnMessage(edit, first?.scale);
  const densityFunction = drawnMessage(edit.second, first?.densityScale);
  return create(SceneSchema, {
    ...base,
    camera: cameraMessage(orbit, bounds),
    layers: base.layers.map((layer, i) =>
      i === 0
        ? {
            ...layer,
            transferFunction: transferFunction ?? layer.transferFunction,
            densityFunction: densityFunction ?? layer.densityFunction,
          }
        : layer,
    ),
  });
}
