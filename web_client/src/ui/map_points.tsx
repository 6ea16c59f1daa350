import type { Signal } from "@preact/signals";
import { drawnMap, endGesture, mapEditOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import { changePoints, type MapTarget, pointsOf, removePoint } from "../state/map_targets";
import type { Slot } from "../state/models";
import {
  extinctionFromOpacity,
  kMaxDrawnOpacity,
  opacityFromExtinction,
} from "../transfer/opacity";
import { toHex } from "../transfer/srgb";
import {
  isEnd,
  type Point,
  sampleAt,
  withColour,
  withMovedPoint,
} from "../transfer/transfer_function";
import type { PlotBox } from "./map_plot";
import { PlotPoints } from "./plot_points";

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
  readonly box: PlotBox;
  readonly target: MapTarget;
  readonly selected: Signal<number>;
}

/** Opacity over the reference length, as drawn, of a point of the map. */
function opacityOf(state: AppState, slot: Slot, point: Point): number {
  const drawn = point.extinction * mapEditOf(state, slot).density;
  return opacityFromExtinction(drawn, state.referenceLength.value);
}

/** The extinction that the map must hold for `opacity` to be drawn. */
export function extinctionFor(state: AppState, slot: Slot, opacity: number): number {
  const bounded = Math.min(kMaxDrawnOpacity, Math.max(0, opacity));
  const { density } = mapEditOf(state, slot);
  return extinctionFromOpacity(bounded, state.referenceLength.value) / density;
}

/** Deletes a point; the one before it is selected. */
export function deletePoint(
  state: AppState,
  slot: Slot,
  part: MapTarget["part"],
  selected: Signal<number>,
  index: number,
): void {
  if (isEnd(pointsOf(state, slot, part), index)) return;
  removePoint(state, slot, part, index);
  selected.value = Math.max(0, index - 1);
}

/** The id of the field for the selected point's colour. */
export const colourId = (slot: Slot, part: MapTarget["part"]): string => `colour-${slot}-${part}`;

/** Opens the browser's picker of a colour field, once the field is about the point selected now. */
export function openColour(id: string): void {
  requestAnimationFrame(() => {
    const field = document.getElementById(id);
    if (!(field instanceof HTMLInputElement)) return;
    field.focus();
    try {
      field.showPicker();
    } catch {
      // A browser without it, or one that wants another click: the field has the focus.
    }
  });
}

/** The points of a map, or of a part of it. */
export function MapPoints({ state, slot, box, target, selected }: Props) {
  const { part, name, points, showsColours, showsOpacity } = target;
  // Where opacities have points of their own these are in the map's colours.
  const shown = showsColours ? undefined : drawnMap(state, slot);
  const colourOf = (point: Point): string =>
    toHex(shown ? sampleAt(shown, point.value, box.axis.along).colour : point.colour);
  return (
    <PlotPoints
      box={box}
      points={points.map((point) => ({
        ...point,
        colour: colourOf(point),
        opacity: opacityOf(state, slot, point),
      }))}
      name={name}
      id={`${slot} ${part}`}
      selected={selected}
      showsOpacity={showsOpacity}
      isFixed={(index) => isEnd(points, index)}
      move={(index, from, value, opacity, gesture) => {
        const extinction =
          opacity === undefined ? from.extinction : extinctionFor(state, slot, opacity);
        const present = pointsOf(state, slot, part);
        const next = withMovedPoint(present, index, value, extinction);
        changePoints(state, slot, part, next, gesture);
      }}
      remove={(index) => deletePoint(state, slot, part, selected, index)}
      recolour={showsColours ? () => openColour(colourId(slot, part)) : undefined}
      paint={
        showsColours
          ? (index) => {
              const present = pointsOf(state, slot, part);
              const colour = present[selected.value]?.colour;
              if (colour) changePoints(state, slot, part, withColour(present, index, colour));
            }
          : undefined
      }
      done={() => endGesture(state)}
    />
  );
}
