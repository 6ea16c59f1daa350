import { isOfThisPicture } from "../state/accuracy";
import type { AppState } from "../state/app_state";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

function saidOf(state: AppState): string {
  const difference = state.difference.value;
  if (!state.comparing.value) {
    return "Compares each pixel with the reference in double precision and shows where they differ.";
  }
  if (!difference || !isOfThisPicture(state, difference)) return "Waits for the exact picture.";
  if (difference.running) return "";
  return difference.stopped && `Stopped: ${difference.stopped}.`;
}

/** Switches to the picture's difference from the reference. */
export function DifferencePanel({ state, port }: Props) {
  if (!state.layer.value) return null;
  const on = state.comparing.value;
  const difference = state.difference.value;
  return (
    <section class="section" aria-labelledby="difference-heading">
      <div class="section-head measure-head">
        <h2 id="difference-heading">Difference from the reference</h2>
        <button
          type="button"
          class="text-button"
          aria-pressed={on}
          aria-label={on ? "Hide the difference" : "Show the difference"}
          onClick={() => port.compare(!on)}
        >
          {on ? "Hide" : "Show"}
        </button>
      </div>
      {on && difference?.running && (
        <progress aria-label="Comparing with the reference" max={1} value={difference.progress} />
      )}
      <p class="hint" role="status">
        {saidOf(state)}
      </p>
    </section>
  );
}
