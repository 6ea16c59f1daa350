import { effect, type Signal, signal, untracked } from "@preact/signals";
import type { AppState } from "./state/app_state";
import { followHover, type HoverPlace, pixelAt } from "./view/hover";
import { followTaps } from "./view/taps";

/** What asks the server for pixels. */
interface Picker {
  pick(inputSeq: bigint, x: number, y: number): void;
  stopPicking(): void;
}

const kMiddle: HoverPlace = { x: 0.5, y: 0.5 };

/**
 * Keeps `state.picked` what the picture shows at the pinned place, or else under the resting
 * pointer. Where there is no pointer to rest, a tap pins its place.
 */
export function followProbe(element: HTMLElement, state: AppState, picker: Picker) {
  const hover: Signal<HoverPlace | undefined> = signal(undefined);
  const unhover = followHover(element, (place) => {
    hover.value = place;
  });
  const untap = followTaps(element, (place) => {
    state.pinned.value = place;
  });
  // Anew for every picture: what lies at a place changes with it.
  const unpick = effect(() => {
    const shown = state.picture.value;
    const place = state.pinned.value ?? hover.value;
    const pixel = place && shown && pixelAt(place, shown.width, shown.height);
    untracked(() => {
      if (pixel) picker.pick(shown.inputSeq, pixel.x, pixel.y);
      else picker.stopPicking();
    });
  });
  return {
    end(): void {
      unhover();
      untap();
      unpick();
    },
    /** Pins the place under the pointer, or the middle; a second time lets it go. */
    togglePin(): void {
      state.pinned.value = state.pinned.value ? undefined : (hover.value ?? kMiddle);
    },
  };
}
