import { type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { openPane, type Pane, type PaneBeginning, type PanePort } from "./pane";
import { steers } from "./state/people";
import type { Orbit } from "./view/camera";
import { linkedOrbit } from "./view/linked";

export const kMostPanes = 4;

type Page = Omit<PanePort, "moved" | "opened">;

/** The views that the page shows side by side; panels and keys are about the active one. */
export class Panes {
  readonly all = signal<readonly Pane[]>([]);
  readonly active: ReadonlySignal<Pane>;
  /** A camera that moves takes those of the other views along. */
  readonly linked = signal(true);
  readonly #active: Signal<Pane>;
  readonly #page: Page;
  /** Cameras that went along with one that moved: they lead no others. */
  readonly #following = new WeakSet<Orbit>();

  /** Opens at least one view. */
  constructor(page: Page, beginnings: readonly PaneBeginning[]) {
    this.#page = page;
    const first = this.#open(beginnings[0] ?? {});
    this.#active = signal(first);
    this.active = this.#active;
    for (const beginning of beginnings.slice(1, kMostPanes)) this.#open(beginning);
  }

  /** Undefined where there are as many as there may be. */
  add(beginning: PaneBeginning): Pane | undefined {
    if (this.all.value.length >= kMostPanes) return undefined;
    return this.#open(beginning);
  }

  activate(pane: Pane): void {
    this.#active.value = pane;
  }

  /** Closes a view; the last one stays. */
  close(pane: Pane): void {
    const others = this.all.value.filter((p) => p !== pane);
    const [first] = others;
    if (!first) return;
    if (this.active.value === pane) this.#active.value = first;
    this.all.value = others;
    pane.close();
  }

  #open(beginning: PaneBeginning): Pane {
    const pane: Pane = openPane(
      {
        ...this.#page,
        moved: () => this.#moved(pane),
        opened: () => this.#opened(pane),
      },
      beginning,
    );
    const activate = (): void => this.activate(pane);
    pane.picture.element.addEventListener("pointerdown", activate);
    pane.picture.element.addEventListener("focus", activate);
    this.all.value = [...this.all.value, pane];
    return pane;
  }

  #moved(from: Pane): void {
    const orbit = from.state.orbit.value;
    if (!this.linked.value || !orbit || this.#following.has(orbit)) return;
    for (const pane of this.all.value) {
      if (pane === from || !steers(pane.state)) continue;
      const next = seenAlike(pane, from);
      if (!next) continue;
      this.#following.add(next);
      pane.state.orbit.value = next;
    }
  }

  #opened(pane: Pane): void {
    const other = this.all.value.find((p) => p !== pane);
    const orbit = this.linked.value && other && seenAlike(pane, other);
    if (!orbit) return;
    this.#following.add(orbit);
    pane.adopt(() => {
      pane.state.orbit.value = orbit;
    });
  }
}

/** The camera that looks at the data of `pane` as `from` looks at its own. */
function seenAlike({ state }: Pane, { state: from }: Pane): Orbit | undefined {
  const { orbit, home } = from;
  if (!orbit.value || !home.value || !state.home.value) return undefined;
  return linkedOrbit(orbit.value, home.value, state.home.value);
}
