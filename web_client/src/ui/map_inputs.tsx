import type { Signal } from "@preact/signals";
import { changeMap, endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { opacityFromExtinction } from "../transfer/opacity";
import { fromHex, toHex } from "../transfer/srgb";
import { isEnd, withColour, withMovedPoint } from "../transfer/transfer_function";
import { formatNumber, formatValue, parseNumber } from "./format";
import { IconButton } from "./icons";
import { deletePoint, extinctionFor } from "./map_points";

interface NumberFieldProps {
  readonly label: string;
  readonly text: string;
  readonly disabled?: boolean;
  readonly take: (value: number) => void;
}

/** A number that is taken when the field is left or Enter is pressed; nonsense is put back. */
function NumberField({ label, text, disabled, take }: NumberFieldProps) {
  return (
    <label class="number">
      <span>{label}</span>
      <input
        type="text"
        inputMode="decimal"
        autocomplete="off"
        value={text}
        disabled={disabled}
        onChange={(e) => {
          const value = parseNumber(e.currentTarget.value);
          if (value !== undefined) take(value);
          e.currentTarget.value = text;
        }}
      />
    </label>
  );
}

interface Props {
  readonly state: AppState;
  readonly selected: Signal<number>;
  readonly showsOpacity: boolean;
}

/** The selected point in numbers: value, opacity, extinction and colour. */
export function MapInputs({ state, selected, showsOpacity }: Props) {
  const { map, density } = state.edit.value.present;
  const index = Math.min(selected.value, map.length - 1);
  const point = map[index];
  if (!point) return null;
  const drawn = point.extinction * density;
  const opacity = opacityFromExtinction(drawn, state.referenceLength.value);
  const span = (map[map.length - 1]?.value ?? 0) - (map[0]?.value ?? 0);
  const move = (value: number, extinction: number): void =>
    changeMap(state, withMovedPoint(map, index, value, extinction));
  return (
    <fieldset class="point-fields">
      <legend>
        Point {index + 1} of {map.length}
      </legend>
      <label class="number colour">
        <span>Colour</span>
        <input
          type="color"
          value={toHex(point.colour)}
          onInput={(e) => {
            const colour = fromHex(e.currentTarget.value);
            if (colour) changeMap(state, withColour(map, index, colour), `colour ${index}`);
          }}
          onChange={() => endGesture(state)}
        />
      </label>
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
          take={(percent) => move(point.value, extinctionFor(state, percent / 100))}
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
        onClick={() => deletePoint(state, selected, index)}
      />
    </fieldset>
  );
}
