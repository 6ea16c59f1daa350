import type { FieldInfo } from "../net/gen/volcast/v1/session_pb";
import { axisOfSlot, drawnMap, fieldOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import { type Slot, usesColours } from "../state/models";
import { mapOf } from "../state/scene_message";
import { type Axis, kStraight } from "../transfer/scale";
import { toHex } from "../transfer/srgb";
import { sampleAt, type TransferFunction } from "../transfer/transfer_function";
import { formatValue } from "./format";
import { legendTicks } from "./legend_ticks";

interface Props {
  readonly state: AppState;
}

interface BarProps {
  readonly field: FieldInfo;
  readonly map: TransferFunction;
  readonly axis: Axis;
}

const kStops = 32;

/** The colours along a field's axis, as a browser paints them; the style says which way they run. */
function coloursOf(map: TransferFunction, axis: Axis, low: number, high: number): string {
  const from = axis.along(low);
  const span = axis.along(high) - from;
  const colours = Array.from({ length: kStops + 1 }, (_, i) => {
    const value = axis.back(from + (span * i) / kStops);
    return toHex(sampleAt(map, value, axis.along).colour);
  });
  return colours.join(", ");
}

function Bar({ field, map, axis }: BarProps) {
  const low = map[0]?.value ?? field.min;
  const high = map[map.length - 1]?.value ?? field.max;
  const text = (v: number): string => formatValue(v, high - low, 3);
  return (
    <figure class="legend-field">
      <figcaption>
        {field.name}
        {field.unit && <span class="legend-unit"> {field.unit}</span>}
      </figcaption>
      <div class="legend-bar" style={{ "--colours": coloursOf(map, axis, low, high) }}>
        {legendTicks(axis, low, high).map(({ value, place }) => (
          <span key={value} class="legend-tick" style={{ "--place": `${100 * place}%` }}>
            {text(value)}
          </span>
        ))}
      </div>
    </figure>
  );
}

/** What the picture's colours mean: fields with their units, values and maps. */
export function LegendOverlay({ state }: Props) {
  const layer = state.layer.value;
  const channels = (layer?.channels ?? []).filter((c) => !c.hidden);
  const slot = (["first", "second"] as Slot[]).find((s) => usesColours(layer, s));
  const field = slot && fieldOf(state, slot);
  if (!layer || (channels.length === 0 && !field)) return null;
  return (
    <div class="legend">
      {channels.length === 0 && slot && field && (
        <Bar field={field} map={drawnMap(state, slot)} axis={axisOfSlot(state, slot)} />
      )}
      {channels.map((channel) => {
        const info = state.dataset.value?.fields.find((f) => f.name === channel.field);
        return (
          info && (
            <Bar
              key={info.name}
              field={info}
              map={mapOf(channel.transferFunction)}
              axis={kStraight}
            />
          )
        );
      })}
    </div>
  );
}
