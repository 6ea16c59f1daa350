import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import {
  changeMap,
  drawnMap,
  redo,
  resetMap,
  undo,
  usesColours,
  usesExtinction,
} from "../state/actions";
import type { AppState } from "../state/app_state";
import { withPointAt } from "../transfer/transfer_function";
import { formatNumber, formatValue } from "./format";
import { IconButton } from "./icons";
import { MapInputs } from "./map_inputs";
import { drawPlot, type PlotBox, rangeOf, valueAt } from "./map_plot";
import { MapPoints } from "./map_points";
import { ColourPresets, DensitySlider, OpacityPresets } from "./map_presets";

interface Props {
  readonly state: AppState;
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

function Hint({ state }: Props) {
  const layer = state.layer.value;
  if (!usesExtinction(layer)) {
    return <p class="hint">Opacity plays no part in this ray model; its colours do.</p>;
  }
  const length = formatNumber(state.referenceLength.value, 3);
  return (
    <p class="hint">
      Opacity is over a length of {length}, a tenth of the data’s diagonal. Extinction is per unit
      of length.
    </p>
  );
}

function Plot({ state, selected }: Props & { readonly selected: { value: number } }) {
  const { canvas, width, theme } = useCanvasFacts();
  const field = state.field.value;
  const { map } = state.edit.value.present;
  const fieldMin = field?.min ?? map[0]?.value ?? 0;
  const fieldMax = field?.max ?? map[map.length - 1]?.value ?? 1;
  const box: PlotBox = { width: width.value, ...rangeOf(map, fieldMin, fieldMax) };
  const showsOpacity = usesExtinction(state.layer.value);

  useSignalEffect(() => {
    const element = canvas.current;
    const shown = state.edit.value.present.map;
    const now = state.field.value;
    theme.value;
    if (!element || width.value === 0) return;
    const low = now?.min ?? shown[0]?.value ?? 0;
    const high = now?.max ?? shown[shown.length - 1]?.value ?? 1;
    const content = {
      box: { width: width.value, ...rangeOf(shown, low, high) },
      map: drawnMap(state),
      referenceLength: state.referenceLength.value,
      histogram: now?.histogram ?? [],
      fieldMin: low,
      fieldMax: high,
      showsOpacity: usesExtinction(state.layer.value),
    };
    drawPlot(element, content, window.devicePixelRatio);
  });

  const add = (event: MouseEvent): void => {
    const at = event.currentTarget as HTMLElement;
    const value = valueAt(box, event.clientX - at.getBoundingClientRect().left);
    const next = withPointAt(map, value);
    changeMap(state, next.map);
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
            box={box}
            selected={selected as Parameters<typeof MapPoints>[0]["selected"]}
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
function placeForNewPoint(state: AppState, selected: number): number | undefined {
  const { map } = state.edit.value.present;
  const gap = (i: number): number => (map[i + 1]?.value ?? 0) - (map[i]?.value ?? 0);
  const gaps = map.slice(0, -1).map((_, i) => i);
  const at = gaps.includes(selected) && gap(selected) > 0 ? selected : undefined;
  const widest = at ?? gaps.sort((a, b) => gap(b) - gap(a))[0];
  if (widest === undefined || gap(widest) <= 0) return undefined;
  return (map[widest]?.value ?? 0) + gap(widest) / 2;
}

/** Colours and extinction over the field's histogram, one map for both. */
export function MapEditor({ state }: Props) {
  const selected = useSignal(0);
  const history = state.edit.value;
  if (!state.layer.value || history.present.map.length === 0) return null;
  if (!usesColours(state.layer.value)) return null;
  const showsOpacity = usesExtinction(state.layer.value);
  const add = (): void => {
    const value = placeForNewPoint(state, selected.value);
    if (value === undefined) return;
    const next = withPointAt(history.present.map, value);
    changeMap(state, next.map);
    selected.value = next.index;
  };
  return (
    <section class="section" aria-labelledby="map-heading">
      <div class="section-head">
        <h2 id="map-heading">{showsOpacity ? "Colour and opacity" : "Colour"}</h2>
        <IconButton icon="add" label="Add a point" onClick={add} />
        <IconButton
          icon="undo"
          label="Undo"
          shortcut="Control+Z"
          disabled={history.past.length === 0}
          onClick={() => undo(state)}
        />
        <IconButton
          icon="redo"
          label="Redo"
          shortcut="Control+Shift+Z"
          disabled={history.future.length === 0}
          onClick={() => redo(state)}
        />
        <IconButton icon="reset" label="Start over" onClick={() => resetMap(state)} />
      </div>
      <Plot state={state} selected={selected} />
      <MapInputs state={state} selected={selected} showsOpacity={showsOpacity} />
      <ColourPresets state={state} />
      {showsOpacity && <OpacityPresets state={state} />}
      {showsOpacity && <DensitySlider state={state} />}
      <Hint state={state} />
    </section>
  );
}
