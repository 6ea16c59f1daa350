import { effect, untracked } from "@preact/signals";
import { isMeasuring, isOfThisView, type Subject, subjectOf } from "./accuracy";
import type { AppState } from "./app_state";
import { atRest } from "./model_thumbnails";
import { steers } from "./people";

/** So long nothing happens before it is measured. */
export const kIdleMs = 4000;

export interface IdlePort {
  measure(): void;
  stop(): void;
  after(ms: number, run: () => void): () => void;
}

/** True where one may measure unasked: who wished for it looks at the chart, and neither view nor page does anything else. */
function mayMeasure(state: AppState): boolean {
  const { options, chartInSight, layer, recording, playing, comparing, difference } = state;
  return (
    options.value.measureIdle &&
    chartInSight.value &&
    layer.value !== undefined &&
    !layer.value.shader?.code && // Code has one way.
    steers(state) &&
    atRest(state) &&
    !recording.value &&
    !playing.value.on &&
    !(comparing.value && difference.value?.running)
  );
}

/**
 * Measures the view once it has rested for `kIdleMs`, and ends what it began when that is not wanted any more;
 * returns its end. What was measured, or stopped by somebody else, is not begun again while the view is the same.
 * A change of the view is no matter here: the server stops by itself.
 */
export function followIdle(state: AppState, port: IdlePort): () => void {
  let cancel = (): void => undefined;
  let mine = false;
  /** What was ended here, so that it may be begun again. */
  let interrupted: Subject | undefined;
  const isKnown = (): boolean => {
    const { value } = state.measured;
    return value !== undefined && value.subject !== interrupted && isOfThisView(state, value);
  };
  const end = effect(() => {
    subjectOf(state); // Read, so that every change begins the wait anew.
    const running = isMeasuring(state);
    const may = mayMeasure(state);
    const wanted = may && !running && !isKnown();
    cancel();
    cancel = () => undefined;
    if (!running) mine = false;
    if (mine && !may && atRest(state)) {
      mine = false;
      interrupted = state.measured.value?.subject;
      untracked(() => port.stop());
    }
    if (!wanted) return;
    cancel = port.after(kIdleMs, () => {
      mine = true;
      port.measure();
    });
  });
  return () => {
    cancel();
    end();
  };
}
