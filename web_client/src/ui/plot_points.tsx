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
import { isModified } from "./plot_canvas";

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
  /** Asks for another colour of a point; absent where points have none. */
  readonly recolour?: ((index: number) => void) | undefined;
  /** Gives a point the colour of the selected one. */
  readonly paint?: ((index: number) => void) | undefined;
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
/** Longer than any system's double click. */
const kDoubleMs = 1000;

const kArrows: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** A map's points: buttons that are dragged, or moved with the keyboard. */
export function PlotPoints<P extends PlotPoint>(props: Props<P>) {
  const { box, points, name, id, selected, showsOpacity, isFixed, move, remove, done } = props;
  const { recolour, paint } = props;
  /** The latest presses: a double click is two on one point, not one on the ground it was added to. */
  const presses = useRef<readonly { readonly index: number; readonly at: number }[]>([]);
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
    presses.current = [...presses.current.slice(-1), { index, at: event.timeStamp }];
    if (event.button === 0 && paint && isModified(event)) {
      event.preventDefault();
      paint(index);
    } else if (event.button === 1) {
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

  const wasDouble = (index: number): boolean => {
    const [first, second] = presses.current;
    return first?.index === index && second?.index === index && second.at - first.at < kDoubleMs;
  };

  /** One that is being dragged stays, even at the edge. */
  const isShown = (index: number, { value }: PlotPoint): boolean => {
    const x = xOf(box, value);
    return drag.current?.index === index || (x > kPadX - 1 && x < box.width - kPadX + 1);
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
            hidden={!isShown(index, point)}
            style={{ left: xOf(box, point.value), top, "--point": point.colour }}
            onFocus={() => {
              selected.value = index;
            }}
            onKeyDown={(e) => keyDown(index, e)}
            onKeyUp={done}
            onPointerDown={(e) => pressed(index, e)}
            onMouseDown={(e) => {
              if (paint && isModified(e)) e.preventDefault(); // The selected one stays so.
            }}
            onPointerMove={moved}
            onPointerUp={released}
            onPointerCancel={released}
            onContextMenu={(e) => {
              if (!recolour) return;
              e.preventDefault();
              selected.value = index;
              recolour(index);
            }}
            onDblClick={(e) => {
              e.stopPropagation();
              if (wasDouble(index)) remove(index);
            }}
          />
        );
      })}
    </div>
  );
}
