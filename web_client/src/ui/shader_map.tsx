import { useSignal } from "@preact/signals";
import type {
  ShaderControl,
  ShaderControl_TransferFunction,
} from "../net/gen/volcast/v1/session_pb";
import { endGesture, usualRangeOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import {
  asDrawn,
  type ControlMap,
  changeControlMap,
  controlMapOf,
  kMostControlPoints,
  withControlPart,
  withControlPoint,
  withoutControlPoint,
} from "../state/control_map";
import { toLinear } from "../state/shader_actions";
import { kStraight } from "../transfer/scale";
import { fromHex, toHex } from "../transfer/srgb";
import { formatNumber, formatValue } from "./format";
import { IconButton } from "./icons";
import { NumberField } from "./inputs";
import { type PlotBox, type PlotContent, valueAt } from "./map_plot";
import { openColour } from "./map_points";
import { PlotCanvas } from "./plot_canvas";
import { PlotPoints } from "./plot_points";

interface Props {
  readonly state: AppState;
  readonly control: ShaderControl;
  readonly kind: ShaderControl_TransferFunction;
}

const boxOf = ({ window }: ControlMap, width: number): PlotBox => ({
  width,
  low: window.min,
  high: window.max,
  axis: kStraight,
});

/** The selected point in numbers. */
function PointFields({
  map,
  index,
  colourId,
  change,
  done,
}: {
  readonly map: ControlMap;
  readonly index: number;
  readonly colourId: string;
  readonly change: (map: ControlMap, gesture?: string) => void;
  readonly done: () => void;
}) {
  const point = map.points[index];
  if (!point) return <p class="hint">There is no point: transparent everywhere.</p>;
  const span = map.window.max - map.window.min;
  return (
    <fieldset class="point-fields">
      <legend>
        Point {index + 1} of {map.points.length}
      </legend>
      <label class="number colour">
        <span>Colour</span>
        <input
          type="color"
          id={colourId}
          value={toHex(point.colour)}
          onInput={(e) => {
            const colour = fromHex(e.currentTarget.value);
            if (colour) change(withControlPart(map, index, { colour }), `colour ${index}`);
          }}
          onChange={done}
        />
      </label>
      <NumberField
        label="Value"
        text={formatValue(point.value, span, 6)}
        take={(value) => change(withControlPart(map, index, { value }))}
      />
      <NumberField
        label="Opacity %"
        text={formatNumber(100 * point.opacity, 4)}
        take={(percent) => change(withControlPart(map, index, { opacity: percent / 100 }))}
      />
      <IconButton
        icon="remove"
        label="Delete the point"
        onClick={() => change(withoutControlPoint(map, index))}
      />
    </fieldset>
  );
}

/** The values that the editor shows of a map. */
function WindowFields({
  map,
  change,
}: {
  readonly map: ControlMap;
  readonly change: (map: ControlMap) => void;
}) {
  const { min, max } = map.window;
  const take = (window: ControlMap["window"]): void => {
    if (window.min < window.max) change({ ...map, window });
  };
  return (
    <div class="fields">
      <NumberField
        label="Window from"
        text={formatValue(min, max - min, 6)}
        take={(value) => take({ min: value, max })}
      />
      <NumberField
        label="Window to"
        text={formatValue(max, max - min, 6)}
        take={(value) => take({ min, max: value })}
      />
    </div>
  );
}

/** A transferFunction control: colours and opacities over the histogram of what it looks up. */
export function ShaderMap({ state, control, kind }: Props) {
  const selected = useSignal(0);
  const { name } = control;
  const read = (): ControlMap => controlMapOf(state, control, kind);
  const map = read();
  const change = (next: ControlMap, gesture?: string): void =>
    changeControlMap(state, name, kind, next, gesture);
  const usual = toLinear(kind.defaultColour ?? { r: 1, g: 1, b: 1 });
  const index = Math.min(selected.value, map.points.length - 1);
  const colourId = `colour-of-${name}`;
  const isFull = map.points.length >= kMostControlPoints;
  const add = (value: number, inSelectedColour = false): void => {
    if (isFull) return;
    const next = withControlPoint(map, value, usual);
    const colour = inSelectedColour ? map.points[index]?.colour : undefined;
    change(colour ? withControlPart(next.map, next.index, { colour }) : next.map);
    selected.value = next.index;
  };
  const content = (width: number): PlotContent => {
    const now = read();
    const box = boxOf(now, width);
    const fields = state.dataset.value?.fields ?? [];
    const field = kind.channel === undefined ? state.field.value : fields[kind.channel];
    return {
      box,
      map: asDrawn(now),
      opacityOf: (opacity) => opacity,
      histogram: field?.histogram ?? [],
      histogramRange: field ? usualRangeOf(field) : { min: box.low, max: box.high },
      showsOpacity: true,
      showsColours: true,
    };
  };
  const remove = (at: number): void => {
    change(withoutControlPoint(map, at));
    selected.value = Math.max(0, at - 1);
  };
  const { min, max } = map.window;
  return (
    <fieldset class="shader-map">
      <legend>{name}</legend>
      <div class="map-plot">
        <PlotCanvas
          content={content}
          add={(x, _, width, modified) => add(valueAt(boxOf(map, width), x), modified)}
        >
          {(width) => (
            <PlotPoints
              box={boxOf(map, width)}
              points={map.points.map((p) => ({ ...p, linear: p.colour, colour: toHex(p.colour) }))}
              name={`${name}, point`}
              id={name}
              selected={selected}
              showsOpacity={true}
              isFixed={() => false}
              move={(at, from, value, opacity, gesture) =>
                change(
                  withControlPart(read(), at, { value, opacity: opacity ?? from.opacity }),
                  gesture,
                )
              }
              remove={remove}
              recolour={() => openColour(colourId)}
              paint={(at) => {
                const colour = map.points[index]?.colour;
                if (colour) change(withControlPart(read(), at, { colour }));
              }}
              done={() => endGesture(state)}
            />
          )}
        </PlotCanvas>
        <div class="map-scale">
          <span>{formatValue(min, max - min)}</span>
          <span>{formatValue(max, max - min)}</span>
        </div>
      </div>
      <PointFields
        map={map}
        index={index}
        colourId={colourId}
        change={change}
        done={() => endGesture(state)}
      />
      <WindowFields map={map} change={change} />
      <button
        type="button"
        class="text-button"
        disabled={isFull}
        onClick={() => {
          const here = map.points[index];
          const next = map.points[index + 1];
          add(here ? (here.value + (next?.value ?? max)) / 2 : (min + max) / 2);
        }}
      >
        Add a point
      </button>
    </fieldset>
  );
}
