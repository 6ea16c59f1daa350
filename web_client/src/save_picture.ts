import { effect } from "@preact/signals";
import { fileNameOf, saveFile } from "./save_file";
import type { AppState } from "./state/app_state";
import { badgeOf } from "./state/badge";
import type { Screen } from "./video/screen";

const kPatienceMs = 4000;

/** Resolves when the exact picture is shown, or when patience ends. */
function exactPicture(state: AppState): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, kPatienceMs);
    const stop = effect(() => {
      if (badgeOf(state, 0).kind !== "final") return;
      clearTimeout(timer);
      queueMicrotask(() => stop());
      resolve();
    });
  });
}

/** Saves the picture on the screen, byte by byte as it came: lossless unless things keep moving. */
export async function savePicture(state: AppState, screen: Screen): Promise<void> {
  await exactPicture(state);
  const picture = await screen.snapshot();
  if (!picture) return;
  const end = picture.type === "image/png" ? "png" : "jpg";
  saveFile(picture, fileNameOf(state.dataset.value?.name ?? "picture", end));
}
