import type { Orbit } from "./camera";
import { flightOf, flown, isFlightKey } from "./fly";
import { takesKey } from "./keyboard";

export interface FlightPort {
  orbit(): Orbit | undefined;
  move(next: Orbit, inputAt: number): void;
}

export interface FlightControl {
  /** True while a key is held: then hands look around. */
  flying(): boolean;
  end(): void;
}

/** Flies while W, A, S, D, E or Q are held, with every animation frame; at rest it does nothing. */
export function controlFlight(port: FlightPort): FlightControl {
  const held = new Set<string>();
  const ended = new AbortController();
  const { signal } = ended;
  let fast = false;
  let before: number | undefined;

  const step = (now: number): void => {
    const orbit = port.orbit();
    if (held.size === 0 || signal.aborted) {
      before = undefined;
      return;
    }
    if (orbit && before !== undefined) {
      port.move(flown(orbit, flightOf(held, fast, (now - before) / 1000)), now);
    }
    before = now;
    requestAnimationFrame(step);
  };
  const release = (): void => held.clear();

  const pressed = (event: KeyboardEvent): void => {
    const chord = event.ctrlKey || event.metaKey || event.altKey;
    fast = event.shiftKey;
    if (chord || !isFlightKey(event.code)) return;
    if (event.defaultPrevented || takesKey(event.target, event.key)) return;
    event.preventDefault();
    const first = held.size === 0;
    held.add(event.code);
    if (first && before === undefined) {
      before = event.timeStamp;
      requestAnimationFrame(step);
    }
  };
  window.addEventListener("keydown", pressed, { signal });
  window.addEventListener(
    "keyup",
    (event) => {
      fast = event.shiftKey;
      held.delete(event.code);
    },
    { signal },
  );
  window.addEventListener("blur", release, { signal });
  return { flying: () => held.size > 0, end: () => ended.abort() };
}
