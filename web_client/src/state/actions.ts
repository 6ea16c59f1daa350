import { create, equals } from "@bufbuild/protobuf";
import {
  type Layer,
  LayerSchema,
  type RayModel,
  type Scene,
  SceneSchema,
} from "../net/gen/volcast/v1/scene_pb";
import { DatasetKind, type FieldInfo } from "../net/gen/volcast/v1/session_pb";
import { type Apart, bothOf, joined, stretchedApart, takenApart } from "../transfer/apart";
import { defaultMap } from "../transfer/presets";
import { type Axis, axisOf, kStraight } from "../transfer/scale";
import { stretched, type TransferFunction } from "../transfer/transfer_function";
import { fitted } from "../view/camera";
import type { AppState, Edit, MapEdit, Maps } from "./app_state";
import type { ViewDocument } from "./document";
import { changed, gestureEnded, redone, startHistory, undone } from "./history";
import type { Slot } from "./models";
import { drawnFrom, mapOf, orbitOf } from "./scene_message";

/** The ray models that the server draws for the shown kind of data. */
export function modelsOf(state: AppState): readonly RayModel[] {
  const welcome = state.welcome.value;
  if (state.dataset.value?.kind === DatasetKind.VOLUME) return welcome?.volumeModels ?? [];
  return welcome?.meshModels ?? [];
}

export const isMesh = (state: AppState): boolean => state.dataset.value?.kind === DatasetKind.MESH;

/** One step that can be undone; changes of one `gesture` are one step. */
export function changeEdit(state: AppState, part: Partial<Edit>, gesture?: string): void {
  const { present } = state.edit.value;
  state.edit.value = changed(state.edit.value, { ...present, ...part }, gesture);
}

/** The scene with parts of its first layer changed. */
export function withLayer(scene: Scene, part: Partial<Layer>): Scene {
  return create(SceneSchema, {
    ...scene,
    layers: scene.layers.map((l, i) => (i === 0 ? create(LayerSchema, { ...l, ...part }) : l)),
  });
}

/** Changes parts of the first layer. */
export function changeLayer(state: AppState, part: Partial<Layer>, gesture?: string): void {
  const scene = state.scene.value;
  if (scene?.layers[0]) changeEdit(state, { scene: withLayer(scene, part) }, gesture);
}

export function changeScene(state: AppState, part: Partial<Scene>, gesture?: string): void {
  const scene = state.scene.value;
  if (scene) changeEdit(state, { scene: create(SceneSchema, { ...scene, ...part }) }, gesture);
}

export function fieldOf(state: AppState, slot: Slot): FieldInfo | undefined {
  return slot === "first" ? state.field.value : state.secondField.value;
}

const kNoMap: MapEdit = { map: [], density: 1 };

/** The map of a slot; without points where there is none. */
export function mapEditOf(state: AppState, slot: Slot = "first"): MapEdit {
  const { present } = state.edit.value;
  return slot === "first" ? present : (present.second ?? kNoMap);
}

/** How a slot's values are laid out: what the map is straight in. */
export function axisOfSlot(state: AppState, slot: Slot = "first"): Axis {
  const field = fieldOf(state, slot);
  const layer = state.layer.value;
  const scale = slot === "first" ? layer?.scale : layer?.densityScale;
  return field ? axisOf(scale, field.min, field.max) : kStraight;
}

/** A slot's map as a part of an edit. */
export const asPart = (slot: Slot, { map, density, smooth, apart }: MapEdit): Partial<Edit> =>
  slot === "first" ? { map, density, smooth, apart } : { second: { map, density, smooth, apart } };

/** Changes a map; changes of one `gesture` are undone together. */
export function changeMap(
  state: AppState,
  map: TransferFunction,
  gesture?: string,
  slot: Slot = "first",
): void {
  const edit = mapEditOf(state, slot);
  if (map === edit.map) return;
  const apart = edit.apart && takenApart(map, axisOfSlot(state, slot));
  changeEdit(state, asPart(slot, { ...edit, map, apart }), gesture);
}

/** Replaces all of a map, as one step that can be undone. */
export function changeMapEdit(state: AppState, edit: MapEdit, slot: Slot = "first"): void {
  changeEdit(state, asPart(slot, edit));
}

/** Edits colours and opacities by points of their own, or together; the picture stays. */
export function switchApart(state: AppState, on: boolean, slot: Slot = "first"): void {
  const edit = mapEditOf(state, slot);
  const apart = on ? takenApart(edit.map, axisOfSlot(state, slot)) : undefined;
  changeEdit(state, asPart(slot, { ...edit, apart }));
}

/** Changes the points of one part of a map that is edited apart. */
export function changeApart(
  state: AppState,
  part: Partial<Apart>,
  gesture?: string,
  slot: Slot = "first",
): void {
  const edit = mapEditOf(state, slot);
  if (!edit.apart) return;
  const apart = { ...edit.apart, ...part };
  const map = joined(apart, axisOfSlot(state, slot));
  changeEdit(state, asPart(slot, { ...edit, map, apart }), gesture);
}

/** Changes the colours or the opacities of a map, by their own points where they have some. */
export function changePart(
  state: AppState,
  part: "colours" | "opacities",
  change: (points: TransferFunction) => TransferFunction,
  slot: Slot = "first",
): void {
  const { map, apart } = mapEditOf(state, slot);
  if (!apart) {
    changeMap(state, change(map), undefined, slot);
    return;
  }
  const points = change(apart[part]);
  changeApart(
    state,
    part === "colours" ? { colours: points } : { opacities: points, knots: undefined },
    undefined,
    slot,
  );
}

export function changeDensity(
  state: AppState,
  density: number,
  gesture?: string,
  slot: Slot = "first",
): void {
  changeEdit(state, asPart(slot, { ...mapEditOf(state, slot), density }), gesture);
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

/** Where nearly all of a field's values are, as the server says. */
export function usualRangeOf(field: FieldInfo): { min: number; max: number } {
  return field.usualRange ?? { min: field.min, max: field.max };
}

/** The map that a field starts with, over what its scale shows. */
export function freshMap(state: AppState, field: FieldInfo, axis: Axis = kStraight): MapEdit {
  const usual = usualRangeOf(field);
  const low = Math.max(usual.min, axis.low);
  const high = Math.min(usual.max, axis.high);
  return { map: defaultMap(low, high, state.referenceLength.value), density: 1 };
}

/** Lays a map out over another range, along its axis; from a high value to a low one turns it round. */
export function changeRange(
  state: AppState,
  first: number,
  last: number,
  slot: Slot = "first",
): void {
  const axis = axisOfSlot(state, slot);
  const inside = (value: number): number => Math.min(axis.high, Math.max(axis.low, value));
  const [from, to] = [inside(first), inside(last)];
  if (from !== to) changeMapEdit(state, laidOver(mapEditOf(state, slot), from, to, axis), slot);
}

/** The same map over another range; see stretched(). */
export function laidOver(edit: MapEdit, first: number, last: number, axis = kStraight): MapEdit {
  const { density, smooth } = edit;
  const apart = edit.apart && stretchedApart(edit.apart, first, last, axis);
  const map = apart ? joined(apart, axis) : stretched(edit.map, first, last, axis);
  return { map, density, smooth, apart };
}

/** Starts a map over, as one step that can be undone. */
export function resetMap(state: AppState, slot: Slot = "first"): void {
  const field = fieldOf(state, slot);
  if (field) changeEdit(state, asPart(slot, freshMap(state, field, axisOfSlot(state, slot))));
}

/**
 * Smooth: opacities have points of their own, whose spline they follow; else extinction is straight
 * between the points.
 */
export function changeSmooth(state: AppState, on: boolean, slot: Slot = "first"): void {
  const edit = mapEditOf(state, slot);
  const smooth = on ? state.referenceLength.value : undefined;
  const apart = on ? (edit.apart ?? bothOf(edit.map)) : edit.apart;
  changeEdit(
    state,
    asPart(slot, { ...edit, smooth, apart: apart && { ...apart, knots: undefined } }),
  );
}

/** The map as it is drawn. */
export function drawnMap(state: AppState, slot: Slot = "first"): TransferFunction {
  const layer = state.layer.value;
  return drawnFrom(mapEditOf(state, slot), slot === "first" ? layer?.scale : layer?.densityScale);
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
  const layer = scene.layers[0];
  const second = mapOf(layer?.densityFunction);
  const edit = {
    scene,
    map: mapOf(layer?.transferFunction),
    density: 1,
    second: second.length > 1 ? { map: second, density: 1 } : undefined,
  };
  state.edit.value = startHistory(edit);
  const field = state.field.value;
  if (edit.map.length <= 1 && field) {
    state.edit.value = startHistory({ ...edit, ...freshMap(state, field) });
  }
  if (!scene.camera) return;
  state.home.value = orbitOf(scene.camera);
  resetCamera(state);
}

/** What is shown; settings that the server refused are no part of it. */
export function currentDocument(state: AppState): ViewDocument | undefined {
  const orbit = state.orbit.value;
  const home = state.home.value;
  const drawn = state.refusal.value ? state.accepted.value : undefined;
  const { scene, map, density, smooth, apart, second } = drawn ?? state.edit.value.present;
  if (!scene || !orbit || !home) return undefined;
  return { scene, orbit, home, edit: { map, density, smooth, apart, second } };
}

/** Shows another state of the same data, as one step that can be undone. */
export function showDocument(state: AppState, { scene, orbit, home, edit }: ViewDocument): void {
  const next = { ...edit, scene };
  const same = JSON.stringify(edit) === JSON.stringify(editedPart(state.edit.value.present));
  const { scene: shown } = state.edit.value.present;
  state.home.value = home;
  if (!same || !shown || !equals(SceneSchema, bare(scene), bare(shown))) {
    state.edit.value = changed(state.edit.value, next);
  }
  state.orbit.value = orbit;
}

const editedPart = ({ map, density, smooth, apart, second }: Edit): Maps => ({
  map,
  density,
  smooth,
  apart,
  second,
});

/** The scene without what its maps and the camera say again. */
const bare = (scene: Scene): Scene => ({
  ...scene,
  camera: undefined,
  layers: scene.layers.map((layer, i) =>
    i > 0 ? layer : { ...layer, transferFunction: undefined, densityFunction: undefined },
  ),
});

export function restoreDocument(state: AppState, document: ViewDocument): void {
  const { scene, orbit, home, edit } = document;
  state.orbit.value = orbit;
  state.home.value = home;
  state.edit.value = startHistory({ ...edit, scene });
}
