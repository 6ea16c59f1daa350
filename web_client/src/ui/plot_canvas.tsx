import { useSignal, useSignalEffect } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { drawPlot, kPadX, type PlotContent } from "./map_plot";

interface Props {
  /** What is drawn in so many CSS pixels; reads signals. */
  readonly content: (width: number) => PlotContent;
  /** A click on empty ground, in CSS pixels of it; `modified`: with Shift, Alt, Ctrl or Command. */
  readonly add: (x: number, y: number, width: number, modified: boolean) => void;
  /** Shows less (factor > 1) or more around a place from 0 to 1. */
  readonly zoom?: ((factor: number, at: number) => void) | undefined;
  /** Moves by a share of what is shown. */
  readonly pan?: ((by: number) => void) | undefined;
  readonly children: (width: number) => ComponentChildren;
}

interface Finger {
  x: number;
  y: number;
}

/** Pixels that a click may move. */
const kStill = 4;

export const isModified = (e: MouseEvent): boolean =>
  e.shiftKey || e.altKey || e.ctrlKey || e.metaKey;

/** The ground that a map is drawn on, as wide as there is room; its points are the children. */
export function PlotCanvas({ content, add, zoom, pan, children }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const width = useSignal(0);
  const theme = useSignal(0);
  /** Fingers, or the mouse, that went down on empty ground. */
  const fingers = useRef(new Map<number, Finger>());
  const wasMoved = useRef(false);
  useEffect(() => {
    const parent = canvas.current?.parentElement;
    if (!parent) return undefined;
    const observer = new ResizeObserver(() => {
      width.value = parent.clientWidth;
    });
    observer.observe(parent);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    const turned = (): void => {
      theme.value += 1;
    };
    dark.addEventListener("change", turned);
    return () => {
      observer.disconnect();
      dark.removeEventListener("change", turned);
    };
  }, []);
  useSignalEffect(() => {
    const element = canvas.current;
    theme.value;
    if (element && width.value > 0)
      drawPlot(element, content(width.value), window.devicePixelRatio);
  });

  const inner = width.value - 2 * kPadX;
  const placeOf = (element: HTMLElement, clientX: number): number => {
    const x = clientX - element.getBoundingClientRect().left - kPadX;
    return Math.min(1, Math.max(0, x / inner));
  };
  const isGround = (e: Event): boolean => e.target === canvas.current;

  const down = (e: PointerEvent & { currentTarget: HTMLElement }): void => {
    if (!isGround(e) || e.button !== 0) return;
    if (fingers.current.size === 0) wasMoved.current = false;
    fingers.current.set(e.pointerId, { x: e.clientX, y: e.clientY });
    e.currentTarget.setPointerCapture(e.pointerId);
  };

  const move = (e: PointerEvent & { currentTarget: HTMLElement }): void => {
    const finger = fingers.current.get(e.pointerId);
    if (!finger) return;
    const [dx, dy] = [e.clientX - finger.x, e.clientY - finger.y];
    if (!wasMoved.current && Math.hypot(dx, dy) < kStill) return;
    wasMoved.current = true;
    const other = [...fingers.current].find(([id]) => id !== e.pointerId)?.[1];
    if (other) {
      const apart = Math.abs(finger.x - other.x);
      const factor = Math.abs(e.clientX - other.x) / Math.max(apart, 1);
      if (apart > 2 * kStill) {
        zoom?.(factor || 1, placeOf(e.currentTarget, (e.clientX + other.x) / 2));
      }
    } else {
      pan?.(-dx / inner);
    }
    fingers.current.set(e.pointerId, { x: e.clientX, y: e.clientY });
  };

  const up = (e: PointerEvent): void => {
    if (fingers.current.size > 1) wasMoved.current = true; // No click ends a pinch.
    fingers.current.delete(e.pointerId);
  };

  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: the buttons are the keyboard's way
    // biome-ignore lint/a11y/useKeyWithClickEvents: the buttons are the keyboard's way
    <div
      class="map-ground"
      onPointerDown={down}
      onPointerMove={move}
      onPointerUp={up}
      onPointerCancel={up}
      onClick={(e) => {
        // The second click of a double click is about what the first one added.
        const onGround = isGround(e) || e.target === e.currentTarget;
        if (!onGround || wasMoved.current || e.detail > 1) return;
        const box = e.currentTarget.getBoundingClientRect();
        add(e.clientX - box.left, e.clientY - box.top, width.value, isModified(e));
      }}
      onWheel={(e) => {
        if (!zoom || !pan || (!e.ctrlKey && !e.metaKey && !e.shiftKey)) return; // Scrolls the panel.
        e.preventDefault();
        const by = e.deltaY || e.deltaX;
        if (e.shiftKey) pan(by / inner);
        else zoom(2 ** (-by / 200), placeOf(e.currentTarget, e.clientX));
      }}
    >
      <canvas ref={canvas} />
      {width.value > 0 && children(width.value)}
    </div>
  );
}
