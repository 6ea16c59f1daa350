/** A place in the picture, as shares of its width and height from the upper left. */
export interface HoverPlace {
  readonly x: number;
  readonly y: number;
}

/** A pointer that rests for this long means what is under it. */
export const kRestMs = 60;

/**
 * Tells where a mouse or pen rests over `element`; undefined when it moves on, leaves, or a button
 * is down. Returns its end.
 */
export function followHover(
  element: HTMLElement,
  rests: (place: HoverPlace | undefined) => void,
): () => void {
  const ended = new AbortController();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let told = false;
  const stop = (): void => {
    clearTimeout(timer);
    if (told) rests(undefined);
    told = false;
  };
  const listen = (type: "pointermove" | "pointerleave" | "pointerdown" | "wheel"): void =>
    element.addEventListener(type, (event) => handle(event as PointerEvent), {
      signal: ended.signal,
      passive: true,
    });
  const handle = (event: PointerEvent): void => {
    if (event.type !== "pointermove" || event.buttons !== 0 || event.pointerType === "touch") {
      stop();
      return;
    }
    clearTimeout(timer);
    const box = element.getBoundingClientRect();
    const place = {
      x: (event.clientX - box.left) / box.width,
      y: (event.clientY - box.top) / box.height,
    };
    timer = setTimeout(() => {
      told = true;
      rests(place);
    }, kRestMs);
  };
  for (const type of ["pointermove", "pointerleave", "pointerdown", "wheel"] as const) listen(type);
  return () => {
    stop();
    ended.abort();
  };
}

/** The pixel at a place of a picture of this size; undefined beside it. */
export function pixelAt(
  place: HoverPlace,
  width: number,
  height: number,
): { x: number; y: number } | undefined {
  const inside = place.x >= 0 && place.x < 1 && place.y >= 0 && place.y < 1;
  if (!inside) return undefined;
  return { x: Math.floor(place.x * width), y: Math.floor(place.y * height) };
}
