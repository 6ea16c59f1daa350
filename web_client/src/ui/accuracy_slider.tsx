import { Integrator } from "../net/gen/volcast/v1/scene_pb";
import { drawAutomatically, drawBy, isMeasuring, isOfThisView } from "../state/accuracy";
import { type Source, type Stop, type Stops, stopsOf, usedStop } from "../state/accuracy_stops";
import { endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { wayOf } from "./accuracy_names";
import { formatMs, formatNumber } from "./format";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

/** "12 ms, error at most 0.3 (1/255)", or what of it is known. */
function figuresOf({ ms, error }: Stop): string {
  const time = ms === undefined ? "" : formatMs(ms);
  const bound = error === undefined ? "" : `error at most ${formatNumber(error, 2)} (1/255)`;
  return [time, bound].filter(Boolean).join(", ");
}

const kSources: Readonly<Record<Source, string>> = {
  measured: "Measured on this view.",
  estimated: "Estimated, from a sample of this view and from costs on the server’s machine.",
  order: "",
};

function noteOf(state: AppState, { source, stops }: Stops): string {
  const { estimated } = state;
  if (source !== "order" || !estimated.value || !isOfThisView(state, estimated.value)) {
    const only = stops.length === 1 ? " One way is both the fastest and the most accurate." : "";
    return kSources[source] + only;
  }
  if (estimated.value.running) return "Estimating…";
  return estimated.value.stopped && `No estimates: ${estimated.value.stopped}.`;
}

/** From the fastest way to draw to the exact one; what is not measured is estimated when it is reached for. */
export function AccuracySlider({ state, port }: Props) {
  const found = stopsOf(state);
  const { stops, source } = found;
  const used = usedStop(state, stops);
  const last = stops.length - 1;
  const stop = stops[used ?? last];
  if (!stop) return null;
  const automatic = state.layer.value?.integrator === Integrator.AUTO;
  const reached = (): void => {
    const { estimated } = state;
    const known = estimated.value && isOfThisView(state, estimated.value);
    if (source === "order" && !known && !isMeasuring(state)) port.measure("estimated");
  };
  const said = `${wayOf(stop.row)}${figuresOf(stop) && `: ${figuresOf(stop)}`}`;
  return (
    <div class="accuracy-slider" onPointerEnter={reached} onFocusCapture={reached}>
      <div class="accuracy-ends" aria-hidden="true">
        <span>Fastest</span>
        <span>Exact</span>
      </div>
      <input
        type="range"
        aria-label="From fastest to exact"
        aria-valuetext={said}
        min={0}
        max={last}
        step={1}
        value={used ?? last}
        list="accuracy-stops"
        data-source={source}
        onInput={(e) => {
          const next = stops[Number(e.currentTarget.value)];
          if (next) drawBy(state, next.row, "accuracy");
        }}
        onChange={() => endGesture(state)}
      />
      <datalist id="accuracy-stops">
        {stops.map(({ row }, i) => (
          <option key={wayOf(row)} value={i} />
        ))}
      </datalist>
      <p class="accuracy-said">
        <output>{used === undefined && last > 0 ? "Drawn in a way beside these." : said}</output>
        {used === undefined && last === 0 && (
          <button type="button" class="text-button" onClick={() => drawBy(state, stop.row)}>
            Draw so
          </button>
        )}
        {automatic ? (
          <span class="accuracy-auto">as the wish asks</span>
        ) : (
          <button type="button" class="text-button" onClick={() => drawAutomatically(state)}>
            As the wish asks
          </button>
        )}
      </p>
      <p class="hint" role="status">
        {noteOf(state, found)}
      </p>
    </div>
  );
}
