import type { Camera, Scene } from "../net/gen/volcast/v1/scene_pb";
import type { TransferFunction } from "../transfer/transfer_function";
import { fitted, frameOf, type Orbit, seenFrom } from "../view/camera";
import { dot } from "../view/vec3";
import { freshMap } from "./actions";
import type { AppState, Edit, MapEdit, Maps } from "./app_state";
import { changed } from "./history";
import { drawnFrom, mapOf, orbitOf } from "./scene_message";

const isClose = (a: number, b: number): boolean =>
  // The server keeps colours and extinctions as 32-bit numbers: 2^-24 of their size, rounded twice.
  Math.abs(a - b) <= 2 ** -22 * Math.max(Math.abs(a), Math.abs(b));

/** True where both maps draw the same, within what 32-bit numbers tell apart. */
export function sameMap(a: TransferFunction, b: TransferFunction): boolean {
  return (
    a.length === b.length &&
    a.every((p, i) => {
      const q = b[i];
      return (
        q !== undefined &&
        isClose(p.value, q.value) &&
        isClose(p.extinction, q.extinction) &&
        isClose(p.colour.r, q.colour.r) &&
        isClose(p.colour.g, q.colour.g) &&
        isClose(p.colour.b, q.colour.b)
      );
    })
  );
}

/**
 * A scene as it is edited: where its map is one that was edited here, with the density, curve and
 * points that it had then, which scenes do not tell.
 */
export function editOf(scene: Scene, known: readonly Edit[]): Edit {
  const layer = scene.layers[0];
  const first = mapOf(layer?.transferFunction);
  const second = mapOf(layer?.densityFunction);
  const draws = (edit: MapEdit | undefined, map: TransferFunction, scale = layer?.scale) =>
    edit !== undefined && edit.map.length > 0 && sameMap(drawnFrom(edit, scale), map);
  const firstOf = known.find((edit) => draws(edit, first));
  const secondOf = known.find((edit) => draws(edit.second, second, layer?.densityScale));
  const { map, density, smooth, apart } = firstOf ?? { map: first, density: 1 };
  const plainSecond = second.length > 1 ? { map: second, density: 1 } : undefined;
  return { scene, map, density, smooth, apart, second: secondOf?.second ?? plainSecond };
}

/** A camera of the server as one turns it here: upright about `axis` where it stands upright. */
export function orbitAbout(camera: Camera, axis: Orbit["axis"] | undefined): Orbit {
  const orbit = orbitOf(camera);
  if (!axis) return orbit;
  const { toEye, up } = frameOf(orbit);
  const upright = seenFrom(orbit, toEye, axis);
  return dot(frameOf(upright).up, up) > 1 - 1e-9 ? upright : orbit;
}

/** So many of the newest edits are looked at when a scene comes. */
const kMostKnown = 20;

/**
 * Shows a scene that the server has: somebody else's change, a step back, or one from a file, which
 * may say how its maps were edited.
 */
export function followScene(state: AppState, scene: Scene, saved?: Maps): void {
  const { past, present } = state.edit.value;
  const known = [present, ...past.slice(-kMostKnown).reverse()];
  const edit = editOf(scene, saved ? [{ ...saved, scene }, ...known] : known);
  const field = state.field.value;
  const fresh = edit.map.length <= 1 && field ? freshMap(state, field) : undefined;
  state.edit.value = changed(state.edit.value, { ...edit, ...fresh });
  if (scene.camera) followCamera(state, scene.camera);
}

export function followCamera(state: AppState, camera: Camera): void {
  state.orbit.value = orbitAbout(camera, state.home.value?.axis);
}

/** Shows the scene of a view that others began, or of a file, by the camera that it has. */
export function joinScene(state: AppState, scene: Scene, saved?: Maps): void {
  if (!scene.camera) return;
  const orbit = orbitOf(scene.camera);
  state.home.value = orbit;
  followScene(state, scene, saved);
  const { bounds, viewport } = state;
  const aspect = viewport.value ? viewport.value.width / viewport.value.height : 1;
  if (bounds.value) state.home.value = fitted(orbit, bounds.value, aspect);
}
