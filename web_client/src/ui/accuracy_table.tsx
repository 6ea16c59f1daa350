import type { AccuracyRow } from "../net/gen/volcast/v1/session_pb";
import { drawBy } from "../state/accuracy";
import type { AppState } from "../state/app_state";
import { errorText, wayOf } from "./accuracy_names";
import { formatMs, formatNumber } from "./format";

interface Props {
  readonly state: AppState;
}

function Row({ state, row }: Props & { readonly row: AccuracyRow }) {
  const layer = state.layer.value;
  const used = row.integrator === layer?.integrator && row.evaluator === layer?.evaluator;
  return (
    <tr data-front={row.onFront ? "" : undefined}>
      <th scope="row">
        <button
          type="button"
          class="text-button"
          aria-pressed={used}
          onClick={() => drawBy(state, row)}
        >
          {wayOf(row)}
        </button>
      </th>
      {row.refusal ? (
        <td colSpan={4}>{row.refusal}</td>
      ) : (
        <>
          <td>{formatMs(row.medianMs)}</td>
          <td>{errorText(row.rmsError)}</td>
          <td>{errorText(row.maxError)}</td>
          <td>{formatNumber(100 * row.shareOver255, 2)} %</td>
        </>
      )}
    </tr>
  );
}

/** The chart's rows in numbers, and those that could not be measured. */
export function AccuracyTable({ state }: Props) {
  const id = state.layer.value?.id;
  const rows = (state.measured.value?.rows ?? []).filter((row) => row.layer === id);
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keys
    <section class="accuracy-table" tabIndex={0} aria-label="Accuracy and cost">
      <table>
        <caption>In bold: no other way is both faster and closer.</caption>
        <thead>
          <tr>
            <th scope="col">Way</th>
            <th scope="col">Time</th>
            <th scope="col">RMS, 1/255</th>
            <th scope="col">Most, 1/255</th>
            <th scope="col">Over 1/255</th>
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => (
            <Row key={wayOf(row)} state={state} row={row} />
          ))}
        </tbody>
      </table>
    </section>
  );
}
