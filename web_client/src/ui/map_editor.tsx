import { type Signal, useSignal } from "@preact/signals";
import {
  axisOfSlot,
  drawnMap,
  fieldOf,
  mapEditOf,
  resetMap,
  switchApart,
  usualRangeOf,
} from "../state/actions";
import type { AppState } from "../state/app_state";
import { addPoint, canBeApart, type MapTarget, pointsOf, targetsOf } from "../state/map_targets";
import { type Slot, usesColours, usesExtinction } from "../state/models";
import { opacityFromExtinction } from "../transfer/opacity";
import type { Axis } from "../transfer/scale";
import type { TransferFunction } from "../transfer/transfer_function";
import { ScaleOptions } from "./field_picker";
import { formatNumber, formatValue } from "./format";
import { IconButton } from "./icons";
import { Check } from "./inputs";
import { lazy } from "./lazy";
import { MapInputs } from "./map_inputs";
import { kBarGap, kPlotHeight, type PlotBox, type PlotContent, rangeOf, valueAt } from "./map_plot";
import { MapPoints } from "./map_points";
import { ColourPresets, DensitySlider, OpacityPresets, SmoothCurve } from "./map_presets";
import { MapRange } from "./map_range";
import { boxWithin, kWhole, panned, type Zoom, zoomed } from "./map_zoom";
import { PlotCanvas } from "./plot_canvas";

const MapFiles = lazy(async () => (await import("./map_files")).MapFiles);

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
}

function Hint({ state, slot }: Props) {
  const layer = state.layer.value;
  if (!usesExtinction(layer, slot)) {
    return <p class="hint">Opacity plays no part here; the colours do.</p>;
  }
  const length = formatNumber(state.referenceLength.value, 3);
  return (
    <p class="hint">
      Opacity is over a length of {length}, a tenth of the data’s diagonal. Extinction is per unit
      of length.{!usesColours(layer, slot) && " Colours play no part here."}
    </p>
  );
}

/** The box that a map is drawn in: reads signals. */
function boxOf(state: AppState, slot: Slot, zoom: Zoom, width: number): PlotBox {
  const field = fieldOf(state, slot);
  const { map } = mapEditOf(state, slot);
  const axis = axisOfSlot(state, slot);
  const usual = field && usualRangeOf(field);
  const low = usual?.min ?? map[0]?.value ?? 0;
  const high = usual?.max ?? map[map.length - 1]?.value ?? 1;
  return boxWithin({ width, axis, ...rangeOf(map, low, high, axis) }, zoom);
}

type Selection = Readonly<Record<MapTarget["part"], Signal<number>>>;

/** What of the editor is shown how; it is no part of the map. */
interface Look {
  readonly zoom: Signal<Zoom>;
  readonly logCounts: Signal<boolean>;
}

interface EditorProps extends Props {
  readonly selected: Selection;
  readonly look: Look;
}

/** Adds a point, or one in the colour of the selected one, and selects it. */
function addAndSelect(
  { state, slot, selected }: EditorProps,
  part: MapTarget["part"],
  value: number,
  inSelectedColour = false,
): void {
  const chosen = pointsOf(state, slot, part)[selected[part].value];
  const colour = inSelectedColour ? chosen?.colour : undefined;
  selected[part].value = addPoint(state, slot, part, value, colour);
}

/** How the plot is looked at: bars by their logarithm, a part of the range. */
function PlotLook({ zoom, logCounts }: Look) {
  const isWhole = zoom.value.from === 0 && zoom.value.to === 1;
  const by = (factor: number) => () => {
    zoom.value = zoomed(zoom.value, factor, 0.5);
  };
  return (
    <div class="map-look">
      <Check
        checked={logCounts.value}
        take={(on) => {
          logCounts.value = on;
        }}
      >
        Logarithmic counts
      </Check>
      <IconButton
        icon="minus"
        label="Show more of the range"
        disabled={isWhole}
        onClick={by(0.5)}
      />
      <IconButton icon="add" label="Show less of the range" onClick={by(2)} />
      <button
        type="button"
        class="text-button"
        disabled={isWhole}
        onClick={() => {
          zoom.value = kWhole;
        }}
      >
        All
      </button>
    </div>
  );
}

function Plot(props: EditorProps) {
  const { state, slot, selected, look } = props;
  const field = fieldOf(state, slot);
  const targets = targetsOf(state, slot);
  const { zoom } = look;
  const ends = boxOf(state, slot, zoom.value, 0);
  const content = (width: number): PlotContent => {
    const now = fieldOf(state, slot);
    const box = boxOf(state, slot, zoom.value, width);
    const length = state.referenceLength.value;
    return {
      box,
      map: drawnMap(state, slot),
      opacityOf: (extinction) => opacityFromExtinction(extinction, length),
      histogram: now?.histogram ?? [],
      histogramRange: now ? usualRangeOf(now) : { min: box.low, max: box.high },
      logCounts: look.logCounts.value,
      showsOpacity: usesExtinction(state.layer.value, slot),
      showsColours: usesColours(state.layer.value, slot),
    };
  };
  // Apart, a click beside the curve is about opacity, one on the bar about colour.
  const add = (x: number, y: number, width: number, modified: boolean): void => {
    const onBar = y > kPlotHeight + kBarGap / 2;
    const target = targets.find((t) => t.part === (onBar ? "colours" : "opacities")) ?? targets[0];
    if (!target) return;
    const value = valueAt(boxOf(state, slot, zoom.value, width), x);
    addAndSelect(props, target.part, value, modified && target.showsColours);
  };
  return (
    <div class="map-plot">
      <PlotCanvas
        content={content}
        add={add}
        zoom={(factor, at) => {
          zoom.value = zoomed(zoom.value, factor, at);
        }}
        pan={(by) => {
          zoom.value = panned(zoom.value, by);
        }}
      >
        {(width) =>
          targets.map((target) => (
            <MapPoints
              key={target.part}
              state={state}
              slot={slot}
              box={boxOf(state, slot, zoom.value, width)}
              target={target}
              selected={selected[target.part]}
            />
          ))
        }
      </PlotCanvas>
      <div class="map-scale">
        <span>{formatValue(ends.low, ends.high - ends.low)}</span>
        <span>{field?.unit ?? ""}</span>
        <span>{formatValue(ends.high, ends.high - ends.low)}</span>
      </div>
      <PlotLook {...look} />
    </div>
  );
}

/** Where the gap after the selected point, or else the widest one, has its middle. */
function placeForNewPoint(map: TransferFunction, axis: Axis, selected: number): number | undefined {
  const { along, back } = axis;
  const place = (i: number): number => along(map[i]?.value ?? 0);
  const gap = (i: number): number => place(i + 1) - place(i);
  const gaps = map.slice(0, -1).map((_, i) => i);
  const at = gaps.includes(selected) && gap(selected) > 0 ? selected : undefined;
  const widest = at ?? gaps.sort((a, b) => gap(b) - gap(a))[0];
  if (widest === undefined || gap(widest) <= 0) return undefined;
  return back(place(widest) + gap(widest) / 2);
}

function headingOf(colours: boolean, opacity: boolean): string {
  if (colours && opacity) return "Colour and opacity";
  return colours ? "Colour" : "Opacity";
}

/** Adds a point, starts over. */
function Tools(props: EditorProps) {
  const { state, slot, selected } = props;
  const add = (part: MapTarget["part"]): void => {
    const points = pointsOf(state, slot, part);
    const value = placeForNewPoint(points, axisOfSlot(state, slot), selected[part].value);
    if (value !== undefined) addAndSelect(props, part, value);
  };
  return (
    <>
      {targetsOf(state, slot).map(({ part, name }) => (
        <IconButton
          key={part}
          icon="add"
          label={
            part === "map"
              ? "Add a point"
              : `Add ${part === "colours" ? "a" : "an"} ${name.toLowerCase()}`
          }
          onClick={() => add(part)}
        />
      ))}
      <IconButton icon="reset" label="Start over" onClick={() => resetMap(state, slot)} />
    </>
  );
}

/** Colours and extinction over a field's histogram, one map for both. */
export function MapEditor({ state, slot }: Props) {
  const selected = { map: useSignal(0), colours: useSignal(0), opacities: useSignal(0) };
  const look = { zoom: useSignal(kWhole), logCounts: useSignal(true) };
  const layer = state.layer.value;
  if (!layer || mapEditOf(state, slot).map.length === 0) return null;
  if (layer.channels.length > 0) return null; // Each has a map of its own.
  const showsColours = usesColours(layer, slot);
  const showsOpacity = usesExtinction(layer, slot);
  if (!showsColours && !showsOpacity) return null;
  const id = `map-heading-${slot}`;
  const of = slot === "second" ? ` by ${layer.densityField}` : "";
  return (
    <section class="section" aria-labelledby={id}>
      <div class="section-head">
        <h2 id={id}>{`${headingOf(showsColours, showsOpacity)}${of}`}</h2>
        <Tools state={state} slot={slot} selected={selected} look={look} />
      </div>
      {slot === "second" && (
        <div class="options">
          <ScaleOptions state={state} slot="second" />
        </div>
      )}
      <Plot state={state} slot={slot} selected={selected} look={look} />
      {targetsOf(state, slot).map((target) => (
        <MapInputs
          key={target.part}
          state={state}
          slot={slot}
          target={target}
          selected={selected[target.part]}
        />
      ))}
      {canBeApart(state, slot) && (
        <Check
          checked={mapEditOf(state, slot).apart !== undefined}
          disabled={mapEditOf(state, slot).smooth !== undefined}
          take={(on) => switchApart(state, on, slot)}
        >
          Colour and opacity have points of their own
        </Check>
      )}
      <MapRange state={state} slot={slot} />
      {showsColours && <ColourPresets state={state} slot={slot} />}
      {showsOpacity && <OpacityPresets state={state} slot={slot} />}
      {showsOpacity && <SmoothCurve state={state} slot={slot} />}
      {showsOpacity && <DensitySlider state={state} slot={slot} />}
      <MapFiles state={state} slot={slot} />
      <Hint state={state} slot={slot} />
    </section>
  );
}
