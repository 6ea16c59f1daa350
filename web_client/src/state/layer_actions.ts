import { create } from "@bufbuild/protobuf";
import {
  CellMarkersSchema,
  type Layer,
  RangeSchema,
  RayModel,
  type Scale,
  Scale_Kind,
  ScaleSchema,
} from "../net/gen/volcast/v1/scene_pb";
import { Association, type FieldInfo } from "../net/gen/volcast/v1/session_pb";
import { defaultMap } from "../transfer/presets";
import { axisOf, positiveDomain } from "../transfer/scale";
import {
  asPart,
  changeEdit,
  changeLayer,
  fieldOf,
  freshMap,
  laidOver,
  mapEditOf,
  usualRangeOf,
  withLayer,
} from "./actions";
import type { AppState, MapEdit } from "./app_state";
import { isEmpty, middleLevel, movedTo, valuesOf } from "./levels";
import { fittedTo, kRunsCode, type Slot } from "./models";

/** What changes of a layer that is shown by another ray model, so that something is drawn. */
export function partsFor(
  layer: Layer,
  model: RayModel,
  field: FieldInfo | undefined,
): Partial<Layer> {
  const needsLevels = model === RayModel.ISOSURFACE && isEmpty(layer.levels) && field;
  return { ...fittedTo(layer, model), ...(needsLevels ? { levels: middleLevel(field) } : {}) };
}

/** Another ray model, with what it needs to draw something. */
export function chooseModel(state: AppState, model: RayModel): void {
  const layer = state.layer.value;
  if (!layer) return;
  const code = layer.shader?.code;
  if (code && !kRunsCode.has(model)) state.codeDraft.value ??= code;
  changeLayer(state, partsFor(layer, model, state.field.value));
}

/** A field with the scale that its map was made for. */
interface LeftField {
  readonly map: MapEdit;
  readonly scale: Scale | undefined;
}

/** Maps of fields that were left, to come back to; by dataset and field. */
const leftFields = new Map<string, LeftField>();
const key = (dataset: string, field: string): string => JSON.stringify([dataset, field]);

function mapFor(state: AppState, field: FieldInfo): MapEdit {
  const { min, max } = usualRangeOf(field);
  const next = max > min ? laidOver(state.edit.value.present, min, max) : undefined;
  if (next && next.map.length > 1) return next;
  return { map: defaultMap(min, max, state.referenceLength.value), density: 1 };
}

/** Shows another field; its map is the one it had, or the shown one over the field's range. */
export function changeField(state: AppState, name: string): void {
  const dataset = state.dataset.value;
  const next = dataset?.fields.find((f) => f.name === name);
  const before = state.field.value;
  const layer = state.layer.value;
  const { scene, map, density, smooth, apart } = state.edit.value.present;
  if (!dataset || !next || !before || !scene || !layer || next.name === before.name) return;
  leftFields.set(key(dataset.id, before.name), {
    map: { map, density, smooth, apart },
    scale: layer.scale,
  });
  const kept = leftFields.get(key(dataset.id, name));
  const part: Partial<Layer> = {
    field: name,
    timeStep: 0,
    scale: kept?.scale,
    interval: undefined,
    levels: layer.levels && movedTo(layer.levels, before, next),
    densityField: layer.densityField === name ? "" : layer.densityField,
  };
  const shown = { smooth: undefined, apart: undefined, ...(kept?.map ?? mapFor(state, next)) };
  changeEdit(state, { ...shown, scene: withLayer(scene, part) });
}

/** Takes density, or colour, from another field; with "" from the first field again. */
export function chooseSecondField(state: AppState, name: string): void {
  const { scene, second } = state.edit.value.present;
  const field = state.dataset.value?.fields.find((f) => f.name === name);
  if (!scene) return;
  const known = name !== "" && state.layer.value?.densityField === name;
  const fresh = field ? freshMap(state, field) : undefined;
  changeEdit(state, {
    second: known ? second : fresh,
    scene: withLayer(scene, {
      densityField: field?.name ?? "",
      densityFunction: undefined,
      densityScale: undefined,
    }),
  });
}

const scaleKey = (slot: Slot): "scale" | "densityScale" =>
  slot === "first" ? "scale" : "densityScale";

/** The map where `scale` can show it: as it is if it fits, else the same shape over the domain. */
function mapUnder(
  edit: MapEdit,
  field: FieldInfo,
  before: Scale | undefined,
  scale: Scale,
): MapEdit {
  const isLog = (s: Scale | undefined): boolean => s?.kind === Scale_Kind.LOG;
  const low = edit.map[0]?.value ?? field.min;
  const high = edit.map[edit.map.length - 1]?.value ?? field.max;
  if (isLog(scale)) {
    const axis = axisOf(scale, field.min, field.max);
    const fits = low >= axis.low && high <= axis.high && high > low;
    return fits || !(axis.low > 0) ? edit : laidOver(edit, axis.low, axis.high);
  }
  // What a logarithm had pushed above 0 gets its range back.
  const pushed = isLog(before) && field.min <= 0 && low > 0;
  return pushed ? laidOver(edit, field.min, field.max) : edit;
}

/** Changes a field's scale; map, interval and levels follow it into what it can show. */
export function changeScale(state: AppState, slot: Slot, scale: Scale, gesture?: string): void {
  const field = fieldOf(state, slot);
  const layer = state.layer.value;
  const { scene } = state.edit.value.present;
  if (!field || !layer || !scene) return;
  const axis = axisOf(scale, field.min, field.max);
  const log = scale.kind === Scale_Kind.LOG;
  const edit = mapUnder(mapEditOf(state, slot), field, layer[scaleKey(slot)], scale);
  const part: Partial<Layer> = { [scaleKey(slot)]: scale };
  if (slot === "first" && log) {
    if (layer.interval && layer.interval.min <= 0) part.interval = undefined;
    const { levels } = layer;
    if (levels && valuesOf(levels).some((v) => v <= 0)) {
      part.levels = middleLevel({ min: axis.low, max: axis.high });
    }
  }
  changeEdit(state, { ...asPart(slot, edit), scene: withLayer(scene, part) }, gesture);
}

/** Another kind of scale, over the whole range of the field where that has a meaning. */
export function chooseScale(state: AppState, slot: Slot, kind: Scale_Kind): void {
  const field = fieldOf(state, slot);
  if (!field) return;
  const exponent = kind === Scale_Kind.POWER ? 0.5 : 0;
  const domain = kind === Scale_Kind.LOG ? positiveDomain(field.min, field.max) : undefined;
  changeScale(state, slot, create(ScaleSchema, { kind, exponent, domain }));
}

/** Shows only values between two ends; undefined: all values. */
export function changeInterval(
  state: AppState,
  interval: { min: number; max: number } | undefined,
  gesture?: string,
): void {
  const range = interval && create(RangeSchema, interval);
  changeLayer(state, { interval: range }, gesture);
}

/** Fields that can say which cells are drawn. */
export function markerFields(state: AppState): readonly FieldInfo[] {
  const fields = state.dataset.value?.fields ?? [];
  return fields.filter((f) => f.association === Association.CELL);
}

/** Draws only cells with these values of a field of cells; with "" all cells. */
export function changeMarkers(state: AppState, field: string, values: readonly number[]): void {
  const markers = field ? create(CellMarkersSchema, { field, values: [...values] }) : undefined;
  changeLayer(state, { markers });
}
