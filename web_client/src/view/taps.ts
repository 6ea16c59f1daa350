import type { HoverPlace } from "./hover";

const kStill = 8;
const kMostMs = 400;

/** Tells where a finger touched `element` for a moment without moving. Returns its end. */
export function followTaps(element: HTMLElement, tapped: (place: HoverPlace) => void): () => void {
  const ended = new AbortController();
  let start: PointerEvent | undefined;
  const listen = (type: "pointerdown" | "pointerup", handle: (e: PointerEvent) => void): void =>
    element.addEventListener(type, handle, { signal: ended.signal, passive: true });
  listen("pointerdown", (event) => {
    // A second finger makes it a pinch.
    start = event.pointerType === "touch" && event.isPrimary ? event : undefined;
  });
  listen("pointerup", (event) => {
    const began = start;
    start = undefined;
    if (!began || event.pointerId !== began.pointerId) return;
    const far = Math.hypot(event.clientX - began.clientX, event.clientY - began.clientY);
    if (far > kStill || event.timeStamp - began.timeStamp > kMostMs) return;
    const box = element.getBoundingClientRect();
    tapped({
      x: (event.clientX - box.left) / box.width,
      y: (event.clientY - box.top) / box.height,
    });
  });
  return () => ended.abort();
}
