import { alongAxis, dollied, dragged, type Orbit, panned, withOtherProjection } from "./camera";
import type { Turn } from "./turning";

/** What a key does besides moving the camera. */
export type KeyAction =
  | "reset"
  | "fullscreen"
  | "help"
  | "undo"
  | "redo"
  | "save"
  | "trackball"
  | "box"
  | "legend"
  | "hud"
  | "pin";

export type KeyMeaning = { readonly move: (orbit: Orbit) => Orbit } | { readonly do: KeyAction };

type Key = Pick<KeyboardEvent, "key" | "code" | "shiftKey" | "ctrlKey" | "metaKey" | "altKey">;

const kTurn = Math.PI / 36;
/** Pictures are measured in heights here: panning moves by a twentieth. */
const kPan = 0.05;
const kDolly = 1.15;

const kArrows: Readonly<Record<string, readonly [x: number, y: number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

const kAxisLetters: Readonly<Record<string, 0 | 1 | 2>> = { x: 0, y: 1, z: 2 };
/** By place: with Shift a digit key types something else. */
const kAxisDigits: Readonly<Record<string, 0 | 1 | 2>> = { Digit1: 0, Digit2: 1, Digit3: 2 };

const kLetters: Readonly<Record<string, KeyAction>> = {
  r: "reset",
  "0": "reset",
  f: "fullscreen",
  c: "save",
  t: "trackball",
  b: "box",
  l: "legend",
  h: "hud",
  i: "pin",
  "?": "help",
};

/** Undefined where the key means nothing here; `turn` is what arrows do. */
export function meaningOf(key: Key, turn: Turn = dragged): KeyMeaning | undefined {
  if (key.altKey) return undefined;
  if (key.ctrlKey || key.metaKey) {
    const letter = key.key.toLowerCase();
    if (letter === "z") return { do: key.shiftKey ? "redo" : "undo" };
    return letter === "y" && !key.shiftKey ? { do: "redo" } : undefined;
  }
  const arrow = kArrows[key.key];
  if (arrow) {
    const [x, y] = arrow;
    return key.shiftKey
      ? { move: (o) => panned(o, x * kPan, y * kPan, 1) }
      : { move: (o) => turn(o, x * kTurn, y * kTurn, 1) };
  }
  const axis = kAxisDigits[key.code] ?? kAxisLetters[key.key.toLowerCase()];
  if (axis !== undefined) return { move: (o) => alongAxis(o, axis, key.shiftKey) };
  switch (key.key) {
    case "+":
    case "=":
      return { move: (o) => dollied(o, 1 / kDolly, { x: 0, y: 0 }, 1) };
    case "-":
    case "_":
      return { move: (o) => dollied(o, kDolly, { x: 0, y: 0 }, 1) };
    case "p":
    case "P":
      return { move: withOtherProjection };
  }
  const action = kLetters[key.key.toLowerCase()];
  return action && { do: action };
}

/** True where a key belongs to the element under the cursor and not to the picture. */
export function takesKey(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.closest("dialog[open]") || target instanceof HTMLSelectElement) return true;
  if (target instanceof HTMLTextAreaElement) return true;
  if (!(target instanceof HTMLInputElement)) return false;
  if (target.type === "text") return true;
  return target.type !== "checkbox" && key.startsWith("Arrow");
}
