import type { Signal } from "@preact/signals";
import { endGesture, mapEditOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import { changePoints, type MapTarget } from "../state/map_targets";
import type { Slot } from "../state/models";
import { opacityFromExtinction } from "../transfer/opacity";
import { fromHex, toHex } from "../transfer/srgb";
import { isEnd, withColour, withMovedPoint } from "../transfer/transfer_function";
import { formatNumber, formatValue } from "./format";
import { IconButton } from "./icons";
import { NumberField } from "./inputs";
import { colourId, deletePoint, extinctionFor } from "./map_points";

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
  readonly target: MapTarget;
  readonly selected: Signal<number>;
}

/** The selected point in numbers: value, opacity, extinction and colour. */
export function MapInputs({ state, slot, target, selected }: Props) {
  const { density } = mapEditOf(state, slot);
  const { part, name, points: map, showsColours, showsOpacity } = target;
  const index = Math.min(selected.value, map.length - 1);
  const point = map[index];
  if (!point) return null;
  const drawn = point.extinction * density;
  const opacity = opacityFromExtinction(drawn, state.referenceLength.value);
  const span = (map[map.length - 1]?.value ?? 0) - (map[0]?.value ?? 0);
  const move = (value: number, extinction: number): void =>
    changePoints(state, slot, part, withMovedPoint(map, index, value, extinction));
  return (
    <fieldset class="point-fields">
      <legend>
        {name} {index + 1} of {map.length}
      </legend>
      {showsColours && (
        <label class="number colour">
          <span>Colour</span>
          <input
            type="color"
            id={colourId(slot, part)}
            value={toHex(point.colour)}
            onInput={(e) => {
              const colour = fromHex(e.currentTarget.value);
              const gesture = `colour ${slot} ${part} ${index}`;
              if (colour) changePoints(state, slot, part, withColour(map, index, colour), gesture);
            }}
            onChange={() => endGesture(state)}
          />
        </label>
      )}
      <NumberField
        label="Value"
        text={formatValue(point.value, span, 6)}
        disabled={isEnd(map, index)}
        take={(value) => move(value, point.extinction)}
      />
      {showsOpacity && (
        <NumberField
          label="Opacity %"
          text={formatNumber(100 * opacity, 4)}
          take={(percent) => move(point.value, extinctionFor(state, slot, percent / 100))}
        />
      )}
      {showsOpacity && (
        <NumberField
          label="Extinction"
          text={formatNumber(drawn, 5)}
          take={(extinction) => move(point.value, extinction / density)}
        />
      )}
      <IconButton
        icon="remove"
        label="Delete the point"
        disabled={isEnd(map, index)}
        onClick={() => deletePoint(state, slot, part, selected, index)}
      />
    </fieldset>
  );
}
