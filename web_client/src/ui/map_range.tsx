import { useSignal } from "@preact/signals";
import { changeRange, fieldOf, mapEditOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import type { Slot } from "../state/models";
import { percentileOf } from "../transfer/percentiles";
import { formatNumber, formatValue } from "./format";
import { NumberField } from "./inputs";

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
}

const bounded = (percent: number): number => Math.min(100, Math.max(0, percent));

/** The values that the map runs over, in numbers or by percentiles of the field. */
export function MapRange({ state, slot }: Props) {
  const low = useSignal(1);
  const high = useSignal(99);
  const { map } = mapEditOf(state, slot);
  const field = fieldOf(state, slot);
  const first = map[0]?.value ?? 0;
  const last = map[map.length - 1]?.value ?? 0;
  const percentiles = field?.percentiles ?? [];
  const from = percentileOf(percentiles, low.value);
  const to = percentileOf(percentiles, high.value);
  const fits = from !== undefined && to !== undefined && from !== to;
  return (
    <fieldset class="point-fields map-range">
      <legend>Range</legend>
      <NumberField
        label="From"
        text={formatValue(first, last - first, 6)}
        take={(value) => changeRange(state, value, last, slot)}
      />
      <NumberField
        label="To"
        text={formatValue(last, last - first, 6)}
        take={(value) => changeRange(state, first, value, slot)}
      />
      <NumberField
        label="Low %"
        text={formatNumber(low.value, 4)}
        take={(percent) => {
          low.value = bounded(percent);
        }}
      />
      <NumberField
        label="High %"
        text={formatNumber(high.value, 4)}
        take={(percent) => {
          high.value = bounded(percent);
        }}
      />
      <button
        type="button"
        class="text-button"
        disabled={!fits}
        title={fits ? undefined : "Both percentiles are the same value"}
        onClick={() => fits && changeRange(state, from, to, slot)}
      >
        Auto range
      </button>
      <button
        type="button"
        class="text-button whole-range"
        disabled={!field || field.min === field.max}
        onClick={() => field && changeRange(state, field.min, field.max, slot)}
      >
        Whole range
      </button>
    </fieldset>
  );
}
