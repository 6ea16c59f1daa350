import { effect } from "@preact/signals";
import type { Session } from "./net/session";
import type { Panes } from "./panes";
import { currentDocument } from "./state/actions";
import { type KeptPage, readPage, writePage } from "./state/keeper";

const kKey = "volcast.page";
const kDelayMs = 250;

/** What this tab showed before it was reloaded, unless its address says something else. */
export function takeKeptPage(): KeptPage | undefined {
  const page = readPage(sessionStorage.getItem(kKey));
  sessionStorage.removeItem(kKey);
  return page?.fragment === location.hash ? page : undefined;
}

/** Keeps what the page shows in the tab's storage, a moment after each change and when it ends. */
export function keepPage(session: Session, panes: Panes): void {
  let timer = 0;
  const write = (ends: boolean): void => {
    clearTimeout(timer);
    const views = panes.all.value.map(({ state, conversation }) => ({
      document: currentDocument(state),
      link: state.seat.value?.link,
      links: state.links.value,
      number: ends ? conversation.number : undefined,
      inputSeq: conversation.inputSeq,
    }));
    const resume = ends ? session.resumption : undefined;
    const fragment = location.hash;
    sessionStorage.setItem(
      kKey,
      writePage({ fragment, linked: panes.linked.value, views, resume }),
    );
  };
  effect(() => {
    for (const { state } of panes.all.value) {
      currentDocument(state);
      state.links.value;
      state.seat.value;
    }
    panes.linked.value;
    clearTimeout(timer);
    timer = window.setTimeout(() => write(false), kDelayMs);
  });
  window.addEventListener("pagehide", () => write(true));
  // The page lives on: nobody else may go on in its place.
  window.addEventListener("pageshow", (event) => {
    if (event.persisted) write(false);
  });
}
