import { drawAutomatically, isOfThisView, type Measured } from "../state/accuracy";
import type { AppState } from "../state/app_state";
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

/** What the ways to draw this view are worth and cost, measured on request. */
export function MeasurePanel({ state, port }: Props) {
  const layer = state.layer.value;
  const measured = state.measured.value;
  if (!layer) return null;
  const running = measured?.running ?? false;
  const said = stateOf(state, measured);
  const chosen = layer.integrator !== 0 || layer.evaluator !== 0;
  return (
    <section class="section" aria-labelledby="measure-heading">
      <div class="section-head measure-head">
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
