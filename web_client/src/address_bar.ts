import { effect } from "@preact/signals";
import { kAnything, wishFor } from "./net/wish";
import type { Pane, PaneBeginning } from "./pane";
import type { Panes } from "./panes";
import { currentDocument, showDocument } from "./state/actions";
import { type Address, type Place, readAddress, writeAddress } from "./state/address";
import { notify, type SharedState } from "./state/app_state";
import { steers } from "./state/people";

const kDelayMs = 500;

/** How views begin that an address names. */
export function beginningsOf(
  places: readonly (Place | undefined)[],
  shared: SharedState,
): readonly PaneBeginning[] {
  return places.map((place): PaneBeginning => {
    if (!place) {
      notify(shared, "error", "The address names a view that cannot be read; data is shown anew.");
      return {};
    }
    return "link" in place ? { wish: { ...kAnything, link: place.link } } : place;
  });
}

/** What a pane is in the address; undefined while nothing is shown in it. */
function placeOf({ state }: Pane): Place | undefined {
  const link = state.seat.value?.link;
  if (link !== undefined) return { link };
  const document = currentDocument(state);
  return document && { document };
}

function show(pane: Pane, place: Place): void {
  const { state, conversation } = pane;
  if ("link" in place) {
    if (state.seat.value?.link !== place.link) conversation.join(place.link);
    return;
  }
  const { document } = place;
  const dataset = document.scene.layers[0]?.dataset;
  if (state.seat.value?.link !== undefined) conversation.leave(document);
  else if (state.layer.value?.dataset !== dataset) conversation.open(wishFor(document));
  else showDocument(state, document);
}

/**
 * Keeps the page's address at what it shows. A deliberate change (settings, data, views) is an entry
 * of the browser's history; while a camera or a slider moves the newest entry is replaced.
 */
export class AddressBar {
  readonly #panes: Panes;
  readonly #shared: SharedState;
  #newest: Address | undefined;
  /** What was shown when the newest entry was made. */
  #entry: readonly unknown[] = [];
  /** True while an entry of the history is being shown. */
  #showing = false;
  #timer = 0;
  /** Addresses are packed one after the other. */
  #writing: Promise<void> = Promise.resolve();

  constructor(panes: Panes, shared: SharedState) {
    this.#panes = panes;
    this.#shared = shared;
    effect(() => this.#changed());
    window.addEventListener("popstate", () => void this.#popped());
  }

  /** An address of what is shown now that leads into nobody's view. */
  async url(): Promise<string> {
    const documents = this.#panes.all.value.map(({ state }) => currentDocument(state));
    const places = documents.flatMap((document) => (document ? [{ document }] : []));
    const fragment = await writeAddress({ places, linked: this.#panes.linked.value });
    return `${location.origin}${location.pathname}${fragment}`;
  }

  #read(): Address | undefined {
    const places = this.#panes.all.value.map(placeOf);
    if (places.some((place) => place === undefined)) return undefined;
    return { places: places as Place[], linked: this.#panes.linked.value };
  }

  /** Equal until somebody does something that is worth an entry. */
  #deed(): readonly unknown[] {
    return this.#panes.all.value.flatMap(({ key, state }) => {
      const { present, gesture } = state.edit.value;
      const mine = steers(state) && gesture === undefined;
      return [key, mine ? present : undefined];
    });
  }

  #changed(): void {
    const address = this.#read();
    const deed = this.#deed();
    if (!address) return;
    const before = this.#newest;
    this.#newest = address;
    const same = (i: number): boolean => deed[i] === this.#entry[i] || deed[i] === undefined;
    const asBefore = deed.length === this.#entry.length && deed.every((_, i) => same(i));
    clearTimeout(this.#timer);
    if (asBefore || this.#showing || !before) {
      this.#timer = window.setTimeout(() => this.#write(address), kDelayMs);
    } else {
      this.#write(address, before);
    }
    this.#entry = deed.map((part, i) => (part === undefined ? this.#entry[i] : part));
  }

  /** Makes `address` the newest entry, or a new one behind that of `before`. */
  #write(address: Address, before?: Address): void {
    this.#writing = this.#writing.then(async () => {
      const fragment = await writeAddress(address);
      if (fragment === location.hash) return;
      if (!before) {
        history.replaceState(null, "", fragment);
        return;
      }
      const last = await writeAddress(before);
      if (last !== location.hash) history.replaceState(null, "", last);
      if (fragment !== last) history.pushState(null, "", fragment);
    });
  }

  async #popped(): Promise<void> {
    await this.#writing;
    const { places, linked } = await readAddress(location.hash);
    this.#showing = true;
    clearTimeout(this.#timer);
    this.#panes.linked.value = linked;
    const beginnings = beginningsOf(places, this.#shared);
    const panes = this.#panes.all.value;
    places.forEach((place, i) => {
      const pane = panes[i];
      if (!pane) this.#panes.add(beginnings[i] ?? {});
      else if (place) show(pane, place);
    });
    for (const pane of panes.slice(Math.max(1, places.length))) this.#panes.close(pane);
    this.#showing = false;
  }
}
