import type { AppState } from "../state/app_state";
import { AccuracyChart } from "./accuracy_chart";
import { AccuracyTable } from "./accuracy_table";

/** What was measured, as a chart and in numbers. Fetched when there is something to show. */
export function MeasureResults({ state }: { readonly state: AppState }) {
  return (
    <>
      <AccuracyChart state={state} />
      <details class="advanced">
        <summary>In numbers</summary>
        <AccuracyTable state={state} />
      </details>
    </>
  );
}
