import type { AppState } from "../state/app_state";
import { boxEdges } from "../view/project";

/** The data's bounds, drawn by the camera of the picture. */
export function BoxOverlay({ state }: { readonly state: AppState }) {
  const orbit = state.shownOrbit.value;
  const bounds = state.bounds.value;
  if (!orbit || !bounds) return null;
  return (
    <svg class="box-overlay" viewBox="-0.5 -0.5 1 1" aria-hidden="true">
      {boxEdges(orbit, bounds).map(({ from, to, hidden }, i) => (
        <line
          key={i}
          class={hidden ? "edge-hidden" : undefined}
          x1={from.x}
          y1={from.y}
          x2={to.x}
          y2={to.y}
        />
      ))}
    </svg>
  );
}
