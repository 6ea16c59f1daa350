import { create } from "@bufbuild/protobuf";
import {
  type Layer,
  LayerSchema,
  RayModel,
  type Scene,
  SceneSchema,
} from "../net/gen/volcast/v1/scene_pb";
import { DatasetKind } from "../net/gen/volcast/v1/session_pb";
import { defaultMap } from "../transfer/presets";
import { scaled, stretched, type TransferFunction } from "../transfer/transfer_function";
import { fitted } from "../view/camera";
import type { AppState, MapEdit } from "./app_state";
import type { ViewDocument } from "./document";
import { changed, gestureEnded, redone, startHistory, undone } from "./history";
import { mapOf, orbitOf } from "./scene_message";

/** The ray models that the server draws for the shown kind of data. */
export function modelsOf(state: AppState): readonly RayModel[] {
  const welcome = state.welcome.value;
  if (state.dataset.value?.kind === DatasetKind.VOLUME) return welcome?.volumeModels ?? [];
  return welcome?.meshModels ?? [];
}

/** True where the picture depends on the map's extinction. */
export function usesExtinction(layer: Layer | undefined): boolean {
  return layer?.model === RayModel.VOLUME || layer?.model === RayModel.UNSPECIFIED;
}

/** True where the picture depends on the map's colours. */
export function usesColours(layer: Layer | undefined): boolean {
  return layer?.model !== RayModel.SURFACE || layer.coloured;
}

/** Changes parts of the first layer. */
export function changeLayer(state: AppState, part: Partial<Layer>): void {
  const scene = state.scene.value;
  const layer = scene?.layers[0];
  if (!scene || !layer) return;
  const next = create(LayerSchema, { ...layer, ...part });
  state.scene.value = create(SceneSchema, {
    ...scene,
    layers: scene.layers.map((l, i) => (i === 0 ? next : l)),
  });
}

export function changeScene(state: AppState, part: Partial<Scene>): void {
  const scene = state.scene.value;
  if (scene) state.scene.value = create(SceneSchema, { ...scene, ...part });
}

/** Maps of fields that were left, to come back to; by dataset and field. */
const leftMaps = new Map<string, MapEdit>();
const key = (dataset: string, field: string): string => JSON.stringify([dataset, field]);

/** Shows another field; its map is the one it had, or the shown one over the field's range. */
export function changeField(state: AppState, name: string): void {
  const dataset = state.dataset.value;
  const next = dataset?.fields.find((f) => f.name === name);
  const before = state.field.value;
  if (!dataset || !next || !before || next.name === before.name) return;
  const edit = state.edit.value.present;
  leftMaps.set(key(dataset.id, before.name), edit);
  const kept = leftMaps.get(key(dataset.id, name));
  const map = next.max > next.min ? stretched(edit.map, next.min, next.max) : [];
  const fresh = map.length > 1 ? map : defaultMap(next.min, next.max, state.referenceLength.value);
  state.edit.value = startHistory(kept ?? { map: fresh, density: edit.density });
  changeLayer(state, { field: name, timeStep: 0 });
}

/** Changes the map; changes of one `gesture` are undone together. */
export function changeMap(state: AppState, map: TransferFunction, gesture?: string): void {
  const { present } = state.edit.value;
  if (map === present.map) return;
  state.edit.value = changed(state.edit.value, { ...present, map }, gesture);
}

export function changeDensity(state: AppState, density: number, gesture?: string): void {
  const { present } = state.edit.value;
  state.edit.value = changed(state.edit.value, { ...present, density }, gesture);
}

export function endGesture(state: AppState): void {
  state.edit.value = gestureEnded(state.edit.value);
}

export function undo(state: AppState): void {
  state.edit.value = undone(state.edit.value);
}

export function redo(state: AppState): void {
  state.edit.value = redone(state.edit.value);
}

/** The map that a field starts with, as one step that can be undone. */
export function resetMap(state: AppState): void {
  const field = state.field.value;
  if (!field) return;
  const map = defaultMap(field.min, field.max, state.referenceLength.value);
  state.edit.value = changed(state.edit.value, { map, density: 1 });
}

/** Extinction as drawn: the map's times the density. */
export function drawnMap(state: AppState): TransferFunction {
  const { map, density } = state.edit.value.present;
  return density === 1 ? map : scaled(map, density);
}

const aspectOf = (state: AppState): number => {
  const size = state.viewport.value;
  return size ? size.width / size.height : 1;
};

/** Everything in sight, from the side that the server chose. */
export function resetCamera(state: AppState): void {
  const home = state.home.value;
  if (!home) return;
  const { bounds } = state;
  const aspect = aspectOf(state);
  const orbit = bounds.value && aspect < 1 ? fitted(home, bounds.value, aspect) : home;
  state.resting.orbit = orbit;
  state.orbit.value = orbit;
}

/** After a change of the viewport: a camera that shows everything goes on showing everything. */
export function refitCamera(state: AppState): void {
  if (state.orbit.value && state.orbit.value === state.resting.orbit) resetCamera(state);
}

/** Takes over a scene that the server made. */
export function adoptScene(state: AppState, scene: Scene): void {
  state.scene.value = scene;
  const map = mapOf(scene.layers[0]?.transferFunction);
  const field = state.field.value;
  const usable = map.length > 1 || !field;
  state.edit.value = startHistory({
    map: usable ? map : defaultMap(field.min, field.max, state.referenceLength.value),
    density: 1,
  });
  if (!scene.camera) return;
  state.home.value = orbitOf(scene.camera);
  resetCamera(state);
}

export function currentDocument(state: AppState): ViewDocument | undefined {
  const scene = state.scene.value;
  const orbit = state.orbit.value;
  const home = state.home.value;
  if (!scene || !orbit || !home) return undefined;
  return { scene, orbit, home, edit: state.edit.value.present };
}

export function restoreDocument(state: AppState, document: ViewDocument): void {
  state.scene.value = document.scene;
  state.orbit.value = document.orbit;
  state.home.value = document.home;
  if (state.edit.value.present !== document.edit) state.edit.value = startHistory(document.edit);
}
