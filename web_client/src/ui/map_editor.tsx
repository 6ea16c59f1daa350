import { type Signal, useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import {
  axisOfSlot,
  changeMap,
  drawnMap,
  fieldOf,
  mapEditOf,
  resetMap,
  usualRangeOf,
} from "../state/actions";
import type { AppState } from "../state/app_state";
import { type Slot, usesColours, usesExtinction } from "../state/models";
import { withPointAt } from "../transfer/transfer_function";
import { ScaleOptions } from "./field_picker";
import { formatNumber, formatValue } from "./format";
import { IconButton } from "./icons";
import { MapInputs } from "./map_inputs";
import { drawPlot, type PlotBox, rangeOf, valueAt } from "./map_plot";
import { MapPoints } from "./map_points";
import { ColourPresets, DensitySlider, OpacityPresets, SmoothCurve } from "./map_presets";
import { MapRange } from "./map_range";

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
}

/** Follows an element's width and the page's theme, for what is drawn on a canvas. */
function useCanvasFacts() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const width = useSignal(0);
  const theme = useSignal(0);
  useEffect(() => {
    const parent = canvas.current?.parentElement;
    if (!parent) return undefined;
    const observer = new ResizeObserver(() => {
      width.value = parent.clientWidth;
    });
    observer.observe(parent);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    const turned = (): void => {
      theme.value += 1;
    };
    dark.addEventListener("change", turned);
    return () => {
      observer.disconnect();
      dark.removeEventListener("change", turned);
    };
  }, []);
  return { canvas, width, theme };
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
function boxOf(state: AppState, slot: Slot, width: number): PlotBox {
  const field = fieldOf(state, slot);
  const { map } = mapEditOf(state, slot);
  const axis = axisOfSlot(state, slot);
  const usual = field && usualRangeOf(field);
  const low = usual?.min ?? map[0]?.value ?? 0;
  const high = usual?.max ?? map[map.length - 1]?.value ?? 1;
  return { width, axis, ...rangeOf(map, low, high, axis) };
}

function Plot({ state, slot, selected }: Props & { readonly selected: Signal<number> }) {
  const { canvas, width, theme } = useCanvasFacts();
  const field = fieldOf(state, slot);
  const { map } = mapEditOf(state, slot);
  const box = boxOf(state, slot, width.value);
  const showsOpacity = usesExtinction(state.layer.value, slot);

  useSignalEffect(() => {
    const element = canvas.current;
    theme.value;
    if (!element || width.value === 0) return;
    const now = fieldOf(state, slot);
    const shown = boxOf(state, slot, width.value);
    const content = {
      box: shown,
      map: drawnMap(state, slot),
      referenceLength: state.referenceLength.value,
      histogram: now?.histogram ?? [],
      histogramRange: now ? usualRangeOf(now) : { min: shown.low, max: shown.high },
      showsOpacity: usesExtinction(state.layer.value, slot),
      showsColours: usesColours(state.layer.value, slot),
    };
    drawPlot(element, content, window.devicePixelRatio);
  });

  const add = (event: MouseEvent): void => {
    const at = event.currentTarget as HTMLElement;
    const value = valueAt(box, event.clientX - at.getBoundingClientRect().left);
    const next = withPointAt(map, value, box.axis.along);
    changeMap(state, next.map, undefined, slot);
    selected.value = next.index;
  };

  return (
    <div class="map-plot">
      {/* biome-ignore lint/a11y/noStaticElementInteractions: the add button is the keyboard's way */}
      <div class="map-ground" onDblClick={add}>
        <canvas ref={canvas} />
        {width.value > 0 && (
          <MapPoints
            state={state}
            slot={slot}
            box={box}
            selected={selected}
            showsOpacity={showsOpacity}
          />
        )}
      </div>
      <div class="map-scale">
        <span>{formatValue(box.low, box.high - box.low)}</span>
        <span>{field?.unit ?? ""}</span>
        <span>{formatValue(box.high, box.high - box.low)}</span>
      </div>
    </div>
  );
}

/** Where the gap after the selected point, or else the widest one, has its middle. */
function placeForNewPoint(state: AppState, slot: Slot, selected: number): number | undefined {
  const { map } = mapEditOf(state, slot);
  const { along, back } = axisOfSlot(state, slot);
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
function Tools({ state, slot, selected }: Props & { readonly selected: Signal<number> }) {
  const add = (): void => {
    const value = placeForNewPoint(state, slot, selected.value);
    if (value === undefined) return;
    const { along } = axisOfSlot(state, slot);
    const next = withPointAt(mapEditOf(state, slot).map, value, along);
    changeMap(state, next.map, undefined, slot);
    selected.value = next.index;
  };
  return (
    <>
      <IconButton icon="add" label="Add a point" onClick={add} />
      <IconButton icon="reset" label="Start over" onClick={() => resetMap(state, slot)} />
    </>
  );
}

/** Colours and extinction over a field's histogram, one map for both. */
export function MapEditor({ state, slot }: Props) {
  const selected = useSignal(0);
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
        <Tools state={state} slot={slot} selected={selected} />
      </div>
      {slot === "second" && (
        <div class="options">
          <ScaleOptions state={state} slot="second" />
        </div>
      )}
      <Plot state={state} slot={slot} selected={selected} />
      <MapInputs
        state={state}
        slot={slot}
        selected={selected}
        showsColours={showsColours}
        showsOpacity={showsOpacity}
      />
      <MapRange state={state} slot={slot} />
      {showsColours && <ColourPresets state={state} slot={slot} />}
      {showsOpacity && <OpacityPresets state={state} slot={slot} />}
      {showsOpacity && <SmoothCurve state={state} slot={slot} />}
      {showsOpacity && <DensitySlider state={state} slot={slot} />}
      <Hint state={state} slot={slot} />
    </section>
  );
}
