import type { AppState } from "../state/app_state";
import { scaleBarOf } from "../view/scale_bar";
import { formatNumber } from "./format";

const kMost = 120;

/** A round length in world units as long as it is in the picture, at the target's depth. */
export function ScaleOverlay({ state }: { readonly state: AppState }) {
  const orbit = state.shownOrbit.value;
  const size = state.viewport.value;
  if (!orbit || !size) return null;
  const bar = scaleBarOf(orbit, size.height / devicePixelRatio, kMost);
  if (bar.length === 0) return null;
  const unit = bar.length === 1 ? "unit" : "units";
  const where = orbit.orthographic ? "" : " at the centre";
  return (
    <p class="scale-bar" title="World units">
      <span class="scale-bar-line" style={{ width: `${bar.pixels}px` }} />
      {formatNumber(bar.length)} {unit}
      {where}
    </p>
  );
}
