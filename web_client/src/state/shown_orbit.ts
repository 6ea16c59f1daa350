import { effect, untracked } from "@preact/signals";
import type { Orbit } from "../view/camera";
import type { AppState } from "./app_state";

/** Cameras by the update that they were sent with. */
export class SentOrbits {
  readonly #sent = new Map<bigint, Orbit>();

  sent(inputSeq: bigint, orbit: Orbit): void {
    this.#sent.set(inputSeq, orbit);
  }

  /** The camera of the picture of an update; older ones are forgotten. */
  take(inputSeq: bigint): Orbit | undefined {
    for (const seq of this.#sent.keys()) if (seq < inputSeq) this.#sent.delete(seq);
    return this.#sent.get(inputSeq);
  }
}

/**
 * Keeps `state.shownOrbit` at the camera of the picture on the screen, so that what is drawn over
 * the picture belongs to it. `opened` takes the camera that came with a view. Returns that, and its end.
 */
export function followShownOrbit(state: AppState): { opened(): void; end(): void } {
  const orbits = new SentOrbits();
  const note = (): void => {
    const orbit = state.orbit.value;
    if (orbit) orbits.sent(state.newestInput.value, orbit);
  };
  const stopNoting = effect(() => {
    state.newestInput.value;
    untracked(note);
  });
  const stopShowing = effect(() => {
    const shown = state.picture.value;
    if (!shown) return;
    const orbit = orbits.take(shown.inputSeq) ?? untracked(() => state.orbit.value);
    state.shownOrbit.value = orbit;
  });
  const end = (): void => {
    stopNoting();
    stopShowing();
  };
  return { opened: note, end };
}
