import type { ViewportSize } from "../state/app_state";

/** Width and height within `maxSide`, their ratio kept, at least one pixel each. */
export function limited(width: number, height: number, maxSide: number): ViewportSize {
  const scale = Math.min(1, maxSide / Math.max(width, height, 1));
  const within = (side: number): number => Math.min(maxSide, Math.max(1, Math.round(side * scale)));
  return { width: within(width), height: within(height) };
}

/** Follows an element's size in device pixels, exact at fractional scales too; returns its end. */
export function followSize(
  element: HTMLElement,
  changed: (width: number, height: number) => void,
): () => void {
  const observer = new ResizeObserver((entries) => {
    const entry = entries[entries.length - 1];
    const exact = entry?.devicePixelContentBoxSize?.[0];
    if (exact) {
      changed(exact.inlineSize, exact.blockSize);
    } else {
      const box = element.getBoundingClientRect();
      const scale = window.devicePixelRatio;
      changed(Math.round(box.width * scale), Math.round(box.height * scale));
    }
  });
  try {
    observer.observe(element, { box: "device-pixel-content-box" });
  } catch {
    observer.observe(element); // Safari has no such box.
  }
  return () => observer.disconnect();
}
