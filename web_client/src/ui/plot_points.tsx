import type { Signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { formatNumber, formatValue } from "./format";
import {
  kBarGap,
  kBarHeight,
  kPadX,
  kPlotHeight,
  opacityOfDrag,
  type PlotBox,
  valueAt,
  xOf,
  yOf,
} from "./map_plot";

/** A point of a map as it is drawn. */
export interface PlotPoint {
  readonly value: number;
  /** As it is shown, from 0 to 1. */
  readonly opacity: number;
  /** Of the display, `#rrggbb`. */
  readonly colour: string;
}

interface Props<P extends PlotPoint> {
  readonly box: PlotBox;
  readonly points: readonly P[];
  /** What people call one of them. */
  readonly name: string;
  /** Tells gestures apart. */
  readonly id: string;
  readonly selected: Signal<number>;
  /** Points are in the plot, and move up and down; else they are on the bar of colours. */
  readonly showsOpacity: boolean;
  /** Ends that keep their value and cannot be deleted. */
  readonly isFixed: (index: number) => boolean;
  /** From how it was when the gesture began; without `opacity`: that is as it was. */
  readonly move: (
    index: number,
    from: P,
    value: number,
    opacity: number | undefined,
    gesture: string,
  ) => void;
  readonly remove: (index: number) => void;
  readonly done: () => void;
}

interface Drag<P> {
  readonly index: number;
  readonly gesture: string;
  readonly start: P;
  readonly x: number;
  readonly y: number;
}

let lastDrag = 0;

const kArrows: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** A map's points: buttons that are dragged, or moved with the keyboard. */
export function PlotPoints<P extends PlotPoint>(props: Props<P>) {
  const { box, points, name, id, selected, showsOpacity, isFixed, move, remove, done } = props;
  const drag = useRef<Drag<P> | undefined>(undefined);
  /** Whether the drag has left its start. */
  const moving = useRef(false);

  /** A hundredth of the range or of the opacity, a tenth of that with Shift. */
  const nudge = (index: number, dx: number, dy: number): void => {
    const point = points[index];
    if (!point) return;
    const x = xOf(box, point.value) + dx * (box.width - 2 * kPadX);
    const value = dx === 0 ? point.value : valueAt(box, x);
    const opacity = dy === 0 ? undefined : point.opacity + dy;
    move(index, point, value, opacity, `nudge ${id} ${index}`);
  };

  const keyDown = (index: number, event: KeyboardEvent): void => {
    const arrow = kArrows[event.key];
    if (arrow && !event.ctrlKey && !event.metaKey) {
      const step = event.shiftKey ? 0.001 : 0.01;
      nudge(index, arrow[0] * step, showsOpacity ? arrow[1] * step : 0);
      event.preventDefault();
    } else if (event.key === "Delete" || event.key === "Backspace") {
      const buttons = (event.currentTarget as HTMLElement).parentElement?.children;
      remove(index);
      (buttons?.[selected.value] as HTMLElement | undefined)?.focus();
      event.preventDefault();
    }
  };

  const pressed = (index: number, event: PointerEvent): void => {
    const start = points[index];
    if (event.button === 1) {
      event.preventDefault();
      remove(index);
    } else if (event.button === 0 && start) {
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
      lastDrag += 1;
      selected.value = index;
      moving.current = false;
      const { clientX: x, clientY: y } = event;
      drag.current = { index, gesture: `drag ${lastDrag}`, start, x, y };
    }
  };

  const moved = (event: PointerEvent): void => {
    const now = drag.current;
    if (!now) return;
    const dx = event.clientX - now.x;
    const dy = event.clientY - now.y;
    if (dx === 0 && dy === 0 && !moving.current) return;
    moving.current = true;
    const value = valueAt(box, xOf(box, now.start.value) + dx);
    const opacity = dy === 0 || !showsOpacity ? undefined : now.start.opacity + opacityOfDrag(dy);
    move(now.index, now.start, value, opacity, now.gesture);
  };

  const released = (): void => {
    drag.current = undefined;
    done();
  };

  const barMiddle = kPlotHeight + kBarGap + kBarHeight / 2;
  return (
    <div class="map-points">
      {points.map((point, index) => {
        const top = showsOpacity ? yOf(Math.min(point.opacity, 1)) : barMiddle;
        const value = formatValue(point.value, box.high - box.low);
        const opacity = `, opacity ${formatNumber(100 * point.opacity, 3)} %`;
        return (
          <button
            key={index}
            type="button"
            class="map-point"
            data-index={index}
            data-end={isFixed(index) ? "" : undefined}
            aria-label={`${name} ${index + 1} of ${points.length}: value ${value}${showsOpacity ? opacity : ""}`}
            aria-pressed={index === selected.value}
            style={{ left: xOf(box, point.value), top, "--point": point.colour }}
            onFocus={() => {
              selected.value = index;
            }}
            onKeyDown={(e) => keyDown(index, e)}
            onKeyUp={done}
            onPointerDown={(e) => pressed(index, e)}
            onPointerMove={moved}
            onPointerUp={released}
            onPointerCancel={released}
            onDblClick={(e) => {
              e.stopPropagation();
              remove(index);
            }}
          />
        );
      })}
    </div>
  );
}
