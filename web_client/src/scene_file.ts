import { fileNameOf, saveFile } from "./save_file";
import { currentDocument } from "./state/actions";
import { type AppState, notify } from "./state/app_state";
import { sceneMessage } from "./state/scene_message";
import { readScene, type SavedScene, writeScene } from "./state/scene_text";

/** Saves the scene as `volcast render --scene` takes it. */
export function saveScene(state: AppState): void {
  const document = currentDocument(state);
  if (!document) return;
  const { scene, orbit, edit } = document;
  const text = writeScene(sceneMessage(scene, orbit, state.bounds.value, edit), edit);
  const file = new Blob([text], { type: "application/json" });
  saveFile(file, fileNameOf(state.dataset.value?.name ?? "scene", "json"));
}

/** The scene in a file; undefined, and said, where there is none. */
export async function loadedScene(state: AppState, file: File): Promise<SavedScene | undefined> {
  const most = state.welcome.value?.limits?.maxMessageBytes ?? 0;
  try {
    if (most > 0 && file.size > most) {
      throw new Error(`it has ${file.size} bytes, the server takes ${most}`);
    }
    return readScene(await file.text());
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    notify(state, "error", `${file.name} is no scene: ${reason}.`);
    return undefined;
  }
}
