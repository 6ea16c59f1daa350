import { effect } from "@preact/signals";
import { fileNameOf, saveFile } from "./save_file";
import { type AppState, notify } from "./state/app_state";
import { badgeOf } from "./state/badge";
import { picturesWithin, type TurnWish, turnOf } from "./state/recording";
import type { Screen } from "./video/screen";
import type { Orbit } from "./view/camera";

const kPatienceMs = 60_000;

/** Resolves when the exact picture of `orbit` is on the screen. */
function exactPictureOf(state: AppState, orbit: Orbit, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const finish = (end: () => void): void => {
      clearTimeout(timer);
      queueMicrotask(() => stop());
      end();
    };
    const timer = setTimeout(
      () => finish(() => reject(new Error("no exact picture came in 60 s"))),
      kPatienceMs,
    );
    signal.addEventListener("abort", () => finish(() => reject(signal.reason)), { once: true });
    const stop = effect(() => {
      const shown = state.shownOrbit.value === orbit;
      if (badgeOf(state, 0).kind === "final" && shown) finish(resolve);
    });
  });
}

/** Draws every picture of a turn and keeps it as it came: lossless. */
async function picturesOf(
  state: AppState,
  screen: Screen,
  orbits: readonly Orbit[],
  signal: AbortSignal,
): Promise<Blob[]> {
  const pictures: Blob[] = [];
  for (const orbit of orbits) {
    state.orbit.value = orbit;
    await exactPictureOf(state, orbit, signal);
    const picture = await screen.snapshot();
    if (picture) pictures.push(picture);
    const { recording } = state;
    if (recording.value) {
      recording.value = { ...recording.value, progress: pictures.length / orbits.length };
    }
  }
  return pictures;
}

/** Records a turn about the data into a file; the camera is then where it was. */
export async function recordTurn(state: AppState, screen: Screen, wish: TurnWish): Promise<void> {
  const start = state.orbit.value;
  if (!start || state.recording.value) return;
  const aborted = new AbortController();
  const { signal } = aborted;
  state.recording.value = { progress: 0, stop: () => aborted.abort("stopped") };
  try {
    const axis = state.home.value?.axis ?? start.axis;
    const orbits = turnOf(start, axis, picturesWithin(wish.pictures));
    const pictures = await picturesOf(state, screen, orbits, signal);
    const files = await import("./recorded_file");
    const file = await files[wish.format](pictures, signal);
    const end = wish.format === "png" ? "zip" : "webm";
    saveFile(file, fileNameOf(state.dataset.value?.name ?? "turn", end));
  } catch (error) {
    if (!signal.aborted) notify(state, "error", `The turn was not recorded: ${String(error)}`);
  } finally {
    state.recording.value = undefined;
    state.orbit.value = start;
  }
}
