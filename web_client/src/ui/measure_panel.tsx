import { useEffect, useRef } from "preact/hooks";
import { drawAutomatically, isOfThisView, type Measured } from "../state/accuracy";
import type { AppState } from "../state/app_state";
import { kIdleMs } from "../state/idle_measure";
import { steers } from "../state/people";
import { Check } from "./inputs";
import { lazy } from "./lazy";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

const MeasureResults = lazy(async () => (await import("./measure_results")).MeasureResults);

function stateOf(state: AppState, measured: Measured | undefined): string {
  if (!measured) return "Draws this view in every way there is and compares with the reference.";
  if (measured.running) return "";
  if (measured.stopped) return `Stopped: ${measured.stopped}.`;
  return isOfThisView(state, measured) ? "" : "Of the view as it was when this was measured.";
}

/** Keeps `state.chartInSight`: true while the element is on the screen of a page that is shown. */
function useSight(state: AppState) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let inSight = false;
    const tell = (): void => {
      state.chartInSight.value = inSight && document.visibilityState === "visible";
    };
    const sight = new IntersectionObserver((entries) => {
      inSight = entries[entries.length - 1]?.isIntersecting ?? false;
      tell();
    });
    if (place.current) sight.observe(place.current);
    document.addEventListener("visibilitychange", tell);
    return () => {
      sight.disconnect();
      document.removeEventListener("visibilitychange", tell);
      state.chartInSight.value = false;
    };
  }, [state]);
  return place;
}

/** What the ways to draw this view are worth and cost, measured on request or when nothing else happens. */
export function MeasurePanel(props: Props) {
  return props.state.layer.value ? <Measurements {...props} /> : null;
}

function Measurements({ state, port }: Props) {
  const place = useSight(state);
  const layer = state.layer.value;
  const measured = state.measured.value;
  const running = measured?.running ?? false;
  const said = stateOf(state, measured);
  const chosen = !!layer?.integrator || !!layer?.evaluator;
  return (
    <section class="section" aria-labelledby="measure-heading">
      <div class="section-head measure-head" ref={place}>
        <h2 id="measure-heading">Error against time</h2>
        {chosen && !running && measured && (
          <button type="button" class="text-button" onClick={() => drawAutomatically(state)}>
            Automatic
          </button>
        )}
        <button
          type="button"
          class="text-button"
          onClick={running ? port.stopMeasuring : () => port.measure("measured")}
        >
          {running ? "Stop" : "Measure"}
        </button>
      </div>
      {steers(state) && (
        <Check checked={state.options.value.measureIdle} take={() => port.toggle("measureIdle")}>
          Also when nothing happens for {kIdleMs / 1000} s
        </Check>
      )}
      {running && (
        <progress aria-label="Measuring accuracy" max={1} value={measured?.progress ?? 0} />
      )}
      <p class="hint" role="status">
        {said}
      </p>
      {measured && measured.rows.length > 0 && <MeasureResults state={state} />}
    </section>
  );
}
