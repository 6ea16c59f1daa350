import { dollied, type Orbit, panned, type ScreenPoint } from "./camera";
import type { Turn } from "./turning";

/** What the control needs to know and to say; `inputAt` is when the input happened. */
export interface CameraPort {
  orbit(): Orbit | undefined;
  move(next: Orbit, inputAt: number): void;
  reset(inputAt: number): void;
  /** What a drag does; `around`: asked for by the Alt key. */
  turn(around: boolean): Turn;
}

interface Finger {
  x: number;
  y: number;
}

/** Half a turn for a drag over the picture's shorter side. */
const turnPerPixel = (element: HTMLElement): number =>
  Math.PI / Math.max(240, Math.min(element.clientWidth, element.clientHeight));

/** Wheel distance to a factor; a pinch on a trackpad arrives as a wheel with Ctrl. */
export function wheelFactor(event: Pick<WheelEvent, "deltaY" | "deltaMode" | "ctrlKey">): number {
  const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
  const bounded = Math.max(-400, Math.min(400, pixels));
  return Math.exp(bounded * (event.ctrlKey ? 0.008 : 0.0016));
}

/**
 * Mouse, pen and touch on `element`: one finger or the left button turns, two fingers, the other
 * buttons or Shift move, Alt looks around, the wheel and pinching dolly towards what is under them, a double click
 * resets. Events that the browser joined into one frame are seen as they happen. Returns its end.
 */
export function controlCamera(element: HTMLElement, port: CameraPort): () => void {
  const fingers = new Map<number, Finger>();
  const ended = new AbortController();
  const listen = <K extends keyof HTMLElementEventMap>(
    type: K,
    handle: (event: HTMLElementEventMap[K]) => void,
  ): void => element.addEventListener(type, handle, { signal: ended.signal, passive: false });

  const fromMiddle = (x: number, y: number): ScreenPoint => {
    const box = element.getBoundingClientRect();
    return { x: x - box.left - box.width / 2, y: y - box.top - box.height / 2 };
  };

  const moveTwo = (orbit: Orbit, finger: Finger, event: PointerEvent): Orbit => {
    const other = [...fingers.values()].find((f) => f !== finger);
    if (!other) return orbit;
    const before = Math.hypot(finger.x - other.x, finger.y - other.y);
    const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
    const dx = (event.clientX - finger.x) / 2;
    const dy = (event.clientY - finger.y) / 2;
    const moved = panned(orbit, dx, dy, element.clientHeight);
    const middle = fromMiddle((event.clientX + other.x) / 2, (event.clientY + other.y) / 2);
    const factor = before > 1 && after > 1 ? before / after : 1;
    return dollied(moved, factor, middle, element.clientHeight);
  };

  const moveOne = (orbit: Orbit, finger: Finger, event: PointerEvent): Orbit => {
    const dx = event.clientX - finger.x;
    const dy = event.clientY - finger.y;
    const pans = event.shiftKey || (event.buttons & 6) !== 0;
    if (pans) return panned(orbit, dx, dy, element.clientHeight);
    return port.turn(event.altKey)(orbit, dx, dy, turnPerPixel(element));
  };

  const moved = (event: PointerEvent): void => {
    const finger = fingers.get(event.pointerId);
    const orbit = port.orbit();
    if (!finger || !orbit || (event.clientX === finger.x && event.clientY === finger.y)) return;
    const next = fingers.size > 1 ? moveTwo(orbit, finger, event) : moveOne(orbit, finger, event);
    finger.x = event.clientX;
    finger.y = event.clientY;
    port.move(next, event.timeStamp);
  };

  listen("pointerdown", (event) => {
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    element.setPointerCapture(event.pointerId);
    element.dataset.dragging = "";
  });
  const released = (event: PointerEvent): void => {
    fingers.delete(event.pointerId);
    if (fingers.size === 0) delete element.dataset.dragging;
  };
  listen("pointerup", (event) => {
    moved(event);
    released(event);
  });
  listen("pointercancel", released);
  listen("pointermove", moved);
  // Secure contexts see each move as it happens; the joined pointermove then finds nothing new.
  element.addEventListener("pointerrawupdate", (event) => moved(event as PointerEvent), {
    signal: ended.signal,
  });
  listen("contextmenu", (event) => event.preventDefault());
  listen("wheel", (event) => {
    event.preventDefault();
    const orbit = port.orbit();
    if (!orbit || event.deltaY === 0) return;
    const at = fromMiddle(event.clientX, event.clientY);
    port.move(dollied(orbit, wheelFactor(event), at, element.clientHeight), event.timeStamp);
  });
  listen("dblclick", (event) => port.reset(event.timeStamp));
  return () => ended.abort();
}
