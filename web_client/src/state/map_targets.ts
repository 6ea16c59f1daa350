import type { TransferFunction } from "../transfer/transfer_function";
import { changeApart, changeMap, mapEditOf } from "./actions";
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
  if (apart && canBeApart(state, slot)) {
    const { colours, opacities } = apart;
    return [
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
  }
  const showsColours = usesColours(layer, slot);
  const showsOpacity = usesExtinction(layer, slot);
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
