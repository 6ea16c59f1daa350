import { effect } from "@preact/signals";
import { currentDocument } from "./actions";
import type { AppState } from "./app_state";
import { readDocument, type ViewDocument, writeDocument } from "./document";

const kKey = "volcast.view";
const kDelayMs = 250;

/** What this tab showed before it was reloaded. */
export function keptDocument(): ViewDocument | undefined {
  return readDocument(sessionStorage.getItem(kKey));
}

/** Keeps the view in the tab's storage, a moment after each change; returns its end. */
export function keepDocument(state: AppState): () => void {
  let timer = 0;
  const write = (): void => {
    clearTimeout(timer);
    const document = currentDocument(state);
    if (document) sessionStorage.setItem(kKey, writeDocument(document));
  };
  const stop = effect(() => {
    currentDocument(state);
    clearTimeout(timer);
    timer = window.setTimeout(write, kDelayMs);
  });
  window.addEventListener("pagehide", write);
  return () => {
    clearTimeout(timer);
    window.removeEventListener("pagehide", write);
    stop();
  };
}
