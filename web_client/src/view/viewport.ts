import type { ViewportSize } from "../state/app_state";

/** Width and height within `maxSide`, their ratio kept, at least one pixel each. */
export function limited(width: number, height: number, maxSide: number): ViewportSize {
  const scale = Math.min(1, maxSide / Math.max(width, height, 1));
  const within = (side: number): number => Math.min(maxSide, Math.max(1, Math.round(side * scale)));
  return { width: within(width), height: within(height) };
}

/**
 * The number of device pixels along a side. `exact` comes from the browser's layout and is right
 * at fractional scales; where a device is only emulated it belongs to the real screen instead,
 * which shows in its distance from `css * scale`.
 */
export function devicePixels(css: number, scale: number, exact: number | undefined): number {
  const expected = css * scale;
  if (exact !== undefined && Math.abs(exact - expected) <= 1.5) return exact;
  return Math.round(expected);
}

/** Follows an element's size in device pixels, exact at fractional scales too; returns its end. */
export function followSize(
  element: HTMLElement,
  changed: (width: number, height: number) => void,
): () => void {
  const observer = new ResizeObserver((entries) => {
    const exact = entries[entries.length - 1]?.devicePixelContentBoxSize?.[0];
    const box = element.getBoundingClientRect();
    const scale = window.devicePixelRatio;
    changed(
      devicePixels(box.width, scale, exact?.inlineSize),
      devicePixels(box.height, scale, exact?.blockSize),
    );
  });
  try {
    observer.observe(element, { box: "device-pixel-content-box" });
  } catch {
    observer.observe(element); // Safari has no such box.
  }
  return () => observer.disconnect();
}
