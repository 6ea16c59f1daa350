import type { AppState } from "../state/app_state";
import { AxesOverlay } from "./overlay_axes";
import { BoxOverlay } from "./overlay_box";
import { LegendOverlay } from "./overlay_legend";
import { ScaleOverlay } from "./overlay_scale";

/** What is drawn over the picture; what is off is not there. */
export function Overlay({ state }: { readonly state: AppState }) {
  const { axes, scaleBar, box, legend } = state.options.value;
  return (
    <div class="overlay">
      {box && <BoxOverlay state={state} />}
      {axes && <AxesOverlay state={state} />}
      {legend && <LegendOverlay state={state} />}
      {scaleBar && <ScaleOverlay state={state} />}
    </div>
  );
}
