import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { AppState } from "../state/app_state";
import { type HudRow, hudRows, lineOf } from "./hud_series";

const kRefreshMs = 500;

function Row({ row, now }: { readonly row: HudRow; readonly now: number }) {
  const { name, series, text } = row;
  const newest = series[series.length - 1]?.[1];
  const most = Math.max(...series.map(([, v]) => v));
  return (
    <tr>
      <th scope="row">{name}</th>
      <td>
        <svg class="spark" viewBox="0 0 100 20" preserveAspectRatio="none" aria-hidden="true">
          <polyline points={lineOf(series, now)} />
        </svg>
      </td>
      <td>{newest === undefined ? "–" : text(newest)}</td>
      <td class="hud-most">{newest === undefined ? "–" : text(most)}</td>
    </tr>
  );
}

/** What the last 20 seconds' pictures took, stage by stage. */
export function Hud({ state }: { readonly state: AppState }) {
  const now = useSignal(performance.now());
  useEffect(() => {
    const timer = setInterval(() => {
      now.value = performance.now();
    }, kRefreshMs);
    return () => {
      clearInterval(timer);
      state.samples.value = [];
    };
  }, []);
  const samples = state.samples.value;
  const at = Math.max(now.value, samples[samples.length - 1]?.at ?? 0);
  return (
    <section class="hud" aria-label="Performance">
      <table>
        <thead>
          <tr>
            <th scope="col">
              <span class="spoken">Stage</span>
            </th>
            <th scope="col">20 s</th>
            <th scope="col">Now</th>
            <th scope="col">Most</th>
          </tr>
        </thead>
        <tbody>
          {hudRows(samples, at).map((row) => (
            <Row key={row.name} row={row} now={at} />
          ))}
        </tbody>
      </table>
    </section>
  );
}
