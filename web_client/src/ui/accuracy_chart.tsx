import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { drawBy } from "../state/accuracy";
import type { AppState } from "../state/app_state";
import { kIntegratorLabels } from "../state/models";
import { evaluatorName, wayOf, worthOf } from "./accuracy_names";
import { drawAccuracy, type Place } from "./accuracy_plot";
import { type ChartPoint, nearest, pointsOf } from "./accuracy_points";

interface Props {
  readonly state: AppState;
}

/** Points lie close: a pointer means the nearest one, within so many CSS pixels. */
const kReach = 24;

const kSteps: Readonly<Record<string, number>> = {
  ArrowLeft: -1,
  ArrowUp: -1,
  ArrowRight: 1,
  ArrowDown: 1,
};

/** Arrows go from point to point by time; one of them is where Tab stops. */
function onArrow(event: KeyboardEvent): void {
  const step = kSteps[event.key];
  const button = event.currentTarget as HTMLElement;
  if (!step) return;
  event.preventDefault();
  const all = [...(button.parentElement?.querySelectorAll<HTMLElement>("button") ?? [])];
  all[(all.indexOf(button) + step + all.length) % all.length]?.focus();
}

function Key({ points }: { readonly points: readonly ChartPoint[] }) {
  const integrators = [...new Set(points.map((p) => p.row.integrator))].sort((a, b) => a - b);
  const evaluators = [...new Map(points.map((p) => [p.row.evaluator, p.row])).values()];
  return (
    <ul class="chart-key">
      {integrators.map((i) => (
        <li key={i}>
          <span class="chart-mark" data-integrator={i} /> {kIntegratorLabels[i]}
        </li>
      ))}
      {evaluators.length > 1 &&
        evaluators.map((row) => (
          <li key={`e${row.evaluator}`}>
            <span class="chart-mark" data-evaluator={row.evaluator} /> {evaluatorName(row)}
          </li>
        ))}
    </ul>
  );
}

/** Error against time of the ways to draw the first layer; a click draws it so. */
export function AccuracyChart({ state }: Props) {
  const host = useRef<HTMLDivElement>(null);
  const places = useSignal<readonly Place[]>([]);
  const pointed = useSignal<ChartPoint | undefined>(undefined);
  const redraw = useSignal(0);
  const layer = state.layer.value;
  const points = useComputed(() =>
    pointsOf(state.measured.value?.rows ?? [], state.layer.value?.id ?? ""),
  ).value;
  useEffect(() => {
    const again = (): void => {
      redraw.value += 1;
    };
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", again);
    const size = new ResizeObserver(again);
    if (host.current) size.observe(host.current);
    return () => {
      dark.removeEventListener("change", again);
      size.disconnect();
    };
  }, []);
  useLayoutEffect(() => {
    if (!host.current || points.length === 0) return undefined;
    return drawAccuracy(host.current, points, (drawn) => {
      places.value = drawn;
    });
  }, [points, redraw.value]);
  const under = (event: MouseEvent): ChartPoint | undefined => {
    const box = host.current?.getBoundingClientRect();
    const at = { left: event.clientX - (box?.left ?? 0), top: event.clientY - (box?.top ?? 0) };
    const index = nearest(places.value, at, kReach);
    return index === undefined ? undefined : points[index];
  };
  if (!layer || points.length === 0) return null;
  const isUsed = ({ row }: ChartPoint): boolean =>
    row.integrator === layer.integrator && row.evaluator === layer.evaluator;
  const stop = Math.max(0, points.findIndex(isUsed));
  const said = pointed.value ?? points.find(isUsed);
  return (
    <div class="accuracy-chart">
      {/* biome-ignore lint/a11y/useSemanticElements: a fieldset cannot be laid over the chart */}
      {/* biome-ignore lint/a11y/useKeyWithClickEvents: keys press the points themselves */}
      <div
        class="chart-ground"
        ref={host}
        role="group"
        aria-label="Error against time, fastest first"
        onPointerMove={(e) => {
          pointed.value = under(e);
        }}
        onPointerLeave={() => {
          pointed.value = undefined;
        }}
        onClick={(e) => {
          const point = under(e);
          if (point && e.detail > 0) drawBy(state, point.row);
        }}
      >
        <div class="chart-points">
          {points.map((p, i) => (
            <button
              key={wayOf(p.row)}
              type="button"
              class="chart-point"
              data-integrator={p.row.integrator}
              data-evaluator={p.row.evaluator}
              data-front={p.row.onFront ? "" : undefined}
              data-pointed={said === p ? "" : undefined}
              style={{
                left: `${places.value[i]?.left ?? 0}px`,
                top: `${places.value[i]?.top ?? 0}px`,
              }}
              aria-pressed={isUsed(p)}
              aria-label={`${wayOf(p.row)}: ${worthOf(p.row)}${p.row.onFront ? ", on the front" : ""}`}
              tabIndex={i === stop ? 0 : -1}
              onClick={() => drawBy(state, p.row)}
              onKeyDown={onArrow}
              onFocus={() => {
                pointed.value = p;
              }}
              onBlur={() => {
                pointed.value = undefined;
              }}
            />
          ))}
        </div>
      </div>
      <p class="hint chart-said">
        {said ? `${wayOf(said.row)}: ${worthOf(said.row)}` : "Click a point to draw that way."}
      </p>
      <Key points={points} />
    </div>
  );
}
