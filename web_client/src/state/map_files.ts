import { takenApart } from "../transfer/apart";
import { type EditedMap, isOwnMap, readMap } from "../transfer/map_file";
import { readPreset } from "../transfer/paraview_map";
import { sampleAt, type TransferFunction, withoutIdlePoints } from "../transfer/transfer_function";
import { axisOfSlot, changeMapEdit, mapEditOf } from "./actions";
import type { AppState } from "./app_state";
import type { Slot } from "./models";

/** A preset over the map's range, straight as it is there; without opacities of its own it takes the map's. */
function adopted(state: AppState, slot: Slot, json: unknown): EditedMap {
  const { map: preset, hasOpacity } = readPreset(json, state.referenceLength.value);
  const before = mapEditOf(state, slot);
  const axis = axisOfSlot(state, slot);
  const first = before.map[0]?.value ?? 0;
  const last = before.map[before.map.length - 1]?.value ?? 1;
  const start = preset[0]?.value ?? 0;
  const span = (preset[preset.length - 1]?.value ?? 1) - start;
  const from = axis.along(first);
  const width = axis.along(last) - from;
  const laid: TransferFunction = preset.map((point, i) => {
    const t = (point.value - start) / span;
    const end = i === 0 ? first : i === preset.length - 1 ? last : undefined;
    return { ...point, value: end ?? axis.back(from + t * width) };
  });
  if (hasOpacity) return { map: laid, density: 1 };
  const values = [...laid, ...before.map].map((p) => p.value);
  const joined = [...new Set(values)]
    .sort((a, b) => a - b)
    .map((value) => ({
      ...sampleAt(laid, value, axis.along),
      extinction: sampleAt(before.map, value, axis.along).extinction,
    }));
  const map = withoutIdlePoints(joined, axis.along);
  return { ...before, map, apart: before.apart && { ...before.apart, colours: laid } };
}

/** Takes a map out of a file's text, as one step that can be undone. Errors: why it is none. */
export function takeMapFile(state: AppState, slot: Slot, text: string): void {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw new Error("it is not JSON");
  }
  const isOwn = isOwnMap(json);
  const taken = isOwn ? readMap(json) : adopted(state, slot, json);
  const axis = axisOfSlot(state, slot);
  const outside = taken.map.find((p) => p.value < axis.low || p.value > axis.high);
  if (outside) throw new Error(`the field's scale has no place for the value ${outside.value}`);
  const most = state.welcome.value?.limits?.maxControlPoints || 1024;
  if (taken.map.length > most) {
    throw new Error(`it has ${taken.map.length} points; this server draws ${most}`);
  }
  const wasApart = mapEditOf(state, slot).apart !== undefined && !isOwn;
  const apart = taken.apart ?? (wasApart ? takenApart(taken.map, axis) : undefined);
  changeMapEdit(state, { ...taken, apart }, slot);
}
