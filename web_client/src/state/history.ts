/** A value with its past and future; the longest past is `kLongestPast` steps. */
export interface History<T> {
  readonly past: readonly T[];
  readonly present: T;
  readonly future: readonly T[];
  /** Changes with the same gesture are one step; undefined ends the gesture. */
  readonly gesture: string | undefined;
}

const kLongestPast = 100;

export function startHistory<T>(present: T): History<T> {
  return { past: [], present, future: [], gesture: undefined };
}

/** The next value. Within one `gesture` (a drag, a slider) only its beginning is kept. */
export function changed<T>(history: History<T>, next: T, gesture?: string): History<T> {
  if (next === history.present) return history;
  if (gesture !== undefined && gesture === history.gesture) {
    return { ...history, present: next, future: [] };
  }
  const past = [...history.past, history.present].slice(-kLongestPast);
  return { past, present: next, future: [], gesture };
}

export function gestureEnded<T>(history: History<T>): History<T> {
  return history.gesture === undefined ? history : { ...history, gesture: undefined };
}

export function undone<T>(history: History<T>): History<T> {
  const present = history.past[history.past.length - 1];
  if (present === undefined) return history;
  return {
    past: history.past.slice(0, -1),
    present,
    future: [history.present, ...history.future],
    gesture: undefined,
  };
}

export function redone<T>(history: History<T>): History<T> {
  const present = history.future[0];
  if (present === undefined) return history;
  return {
    past: [...history.past, history.present],
    present,
    future: history.future.slice(1),
    gesture: undefined,
  };
}
