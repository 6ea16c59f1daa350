import {
  axisOfSlot,
  changeDensity,
  changePart,
  changeSmooth,
  endGesture,
  mapEditOf,
} from "../state/actions";
import type { AppState } from "../state/app_state";
import type { Slot } from "../state/models";
import { type ColourMap, kColourMaps } from "../transfer/colour_maps";
import { kOpacityShapes, withColourMap, withOpacityShape } from "../transfer/presets";
import { toHex } from "../transfer/srgb";
import { withReversedColours } from "../transfer/transfer_function";
import { formatNumber } from "./format";
import { Check } from "./inputs";

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
}

const gradient = (map: ColourMap): string =>
  `linear-gradient(90deg in srgb-linear, ${map.stops.map(toHex).join(", ")})`;

/** Ready-made colours over the map's range; the opacity stays. */
export function ColourPresets({ state, slot }: Props) {
  return (
    <fieldset class="swatches">
      <legend>Colours</legend>
      {kColourMaps.map((colours) => (
        <button
          key={colours.id}
          type="button"
          class="swatch"
          title={`${colours.name} (${colours.source})`}
          aria-label={`${colours.name} colours`}
          style={{ backgroundImage: gradient(colours) }}
          onClick={() => {
            changePart(state, "colours", (map) => withColourMap(map, colours), slot);
          }}
        />
      ))}
      <button
        type="button"
        class="text-button"
        onClick={() => {
          const axis = axisOfSlot(state, slot);
          changePart(state, "colours", (map) => withReversedColours(map, axis), slot);
        }}
      >
        Reverse
      </button>
      <details class="advanced sources">
        <summary>Sources and licences</summary>
        <ul>
          {kColourMaps.map(({ id, name, source }) => (
            <li key={id}>
              {name}: {source}
            </li>
          ))}
        </ul>
      </details>
    </fieldset>
  );
}

/** Ready-made opacity curves; the colours stay. */
export function OpacityPresets({ state, slot }: Props) {
  const apply = (id: string): void => {
    const shape = kOpacityShapes.find((s) => s.id === id);
    const length = state.referenceLength.value;
    if (!shape) return;
    changePart(state, "opacities", (map) => withOpacityShape(map, shape, length), slot);
  };
  return (
    <label class="line">
      <span>Opacity curve</span>
      <select
        value=""
        onChange={(e) => {
          apply(e.currentTarget.value);
          e.currentTarget.value = "";
        }}
      >
        <option value="">Choose</option>
        {kOpacityShapes.map((shape) => (
          <option key={shape.id} value={shape.id}>
            {shape.name}
          </option>
        ))}
      </select>
    </label>
  );
}

/** Whether opacity runs straight or smoothly between the points. */
export function SmoothCurve({ state, slot }: Props) {
  const { smooth } = mapEditOf(state, slot);
  return (
    <Check checked={smooth !== undefined} take={(yes) => changeSmooth(state, yes, slot)}>
      Smooth opacity (B-spline)
    </Check>
  );
}

/** All extinctions at once, over four powers of ten. */
export function DensitySlider({ state, slot }: Props) {
  const { density } = mapEditOf(state, slot);
  const gesture = `density ${slot}`;
  return (
    <label class="density">
      <span>
        Density <span class="density-factor">× {formatNumber(density, 3)}</span>
      </span>
      <input
        type="range"
        min={-2}
        max={2}
        step={0.01}
        value={Math.log10(density)}
        aria-valuetext={`times ${formatNumber(density, 3)}`}
        onInput={(e) => changeDensity(state, 10 ** Number(e.currentTarget.value), gesture, slot)}
        onChange={() => endGesture(state)}
        onDblClick={() => changeDensity(state, 1, undefined, slot)}
      />
    </label>
  );
}
