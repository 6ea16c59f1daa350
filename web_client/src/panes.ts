import { type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { openPane, type Pane, type PaneBeginning, type PanePort } from "./pane";
import { steers } from "./state/people";
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
  /** True while cameras go along with one that moved. */
  #following = false;

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
    if (this.#following || !this.linked.value) return;
    this.#following = true;
    for (const pane of this.all.value) {
      if (pane !== from && steers(pane.state)) follow(pane, from);
    }
    this.#following = false;
  }

  #opened(pane: Pane): void {
    const other = this.all.value.find((p) => p !== pane);
    if (this.linked.value && other) pane.adopt(() => follow(pane, other));
  }
}

/** Looks at the data of `pane` as `from` looks at its own. */
function follow({ state }: Pane, { state: from }: Pane): void {
  const { orbit, home } = from;
  if (!orbit.value || !home.value || !state.home.value) return;
  state.orbit.value = linkedOrbit(orbit.value, home.value, state.home.value);
}
