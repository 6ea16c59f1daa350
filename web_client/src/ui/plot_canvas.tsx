import { useSignal, useSignalEffect } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { drawPlot, type PlotContent } from "./map_plot";

interface Props {
  /** What is drawn in so many CSS pixels; reads signals. */
  readonly content: (width: number) => PlotContent;
  /** A double click on empty ground, in CSS pixels of it. */
  readonly add: (x: number, y: number, width: number) => void;
  readonly children: (width: number) => ComponentChildren;
}

/** The ground that a map is drawn on, as wide as there is room; its points are the children. */
export function PlotCanvas({ content, add, children }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const width = useSignal(0);
  const theme = useSignal(0);
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
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: the add button is the keyboard's way
    <div
      class="map-ground"
      onDblClick={(e) => {
        const box = e.currentTarget.getBoundingClientRect();
        add(e.clientX - box.left, e.clientY - box.top, width.value);
      }}
    >
      <canvas ref={canvas} />
      {width.value > 0 && children(width.value)}
    </div>
  );
}
