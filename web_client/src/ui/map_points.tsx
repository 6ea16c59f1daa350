import type { Signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { changeMap, endGesture, mapEditOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import type { Slot } from "../state/models";
import {
  extinctionFromOpacity,
  kMaxDrawnOpacity,
  opacityFromExtinction,
} from "../transfer/opacity";
import { toHex } from "../transfer/srgb";
import { isEnd, type Point, withMovedPoint, withoutPoint } from "../transfer/transfer_function";
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

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
  readonly box: PlotBox;
  readonly selected: Signal<number>;
  readonly showsOpacity: boolean;
}

interface Drag {
  readonly index: number;
  readonly gesture: string;
  readonly start: Point;
  readonly x: number;
  readonly y: number;
}

let lastDrag = 0;

/** Opacity over the reference length, as drawn, of a point of the map. */
function opacityOf(state: AppState, slot: Slot, point: Point): number {
  const drawn = point.extinction * mapEditOf(state, slot).density;
  return opacityFromExtinction(drawn, state.referenceLength.value);
}

/** The extinction that the map must hold for `opacity` to be drawn. */
export function extinctionFor(state: AppState, slot: Slot, opacity: number): number {
  const bounded = Math.min(kMaxDrawnOpacity, Math.max(0, opacity));
  const { density } = mapEditOf(state, slot);
  return extinctionFromOpacity(bounded, state.referenceLength.value) / density;
}

/** Deletes a point; the one before it is selected. */
export function deletePoint(
  state: AppState,
  slot: Slot,
  selected: Signal<number>,
  index: number,
): void {
  const { map } = mapEditOf(state, slot);
  if (isEnd(map, index)) return;
  changeMap(state, withoutPoint(map, index), undefined, slot);
  selected.value = Math.max(0, index - 1);
}

/** Moves by arrow keys: a hundredth of the range or of the opacity, a tenth of that with Shift. */
function nudge({ state, slot, box }: Props, index: number, dx: number, dy: number): void {
  const { map } = mapEditOf(state, slot);
  const point = map[index];
  if (!point) return;
  const value =
    dx === 0 ? point.value : valueAt(box, xOf(box, point.value) + dx * (box.width - 2 * kPadX));
  const extinction =
    dy === 0 ? point.extinction : extinctionFor(state, slot, opacityOf(state, slot, point) + dy);
  changeMap(state, withMovedPoint(map, index, value, extinction), `nudge ${slot} ${index}`, slot);
}

const kArrows: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** The map's points: buttons that are dragged, or moved with the keyboard. */
export function MapPoints(props: Props) {
  const { state, slot, box, selected, showsOpacity } = props;
  const drag = useRef<Drag | undefined>(undefined);
  const { map } = mapEditOf(state, slot);

  const keyDown = (index: number, event: KeyboardEvent): void => {
    const arrow = kArrows[event.key];
    if (arrow && !event.ctrlKey && !event.metaKey) {
      const step = event.shiftKey ? 0.001 : 0.01;
      nudge(props, index, arrow[0] * step, showsOpacity ? arrow[1] * step : 0);
      event.preventDefault();
    } else if (event.key === "Delete" || event.key === "Backspace") {
      const buttons = (event.currentTarget as HTMLElement).parentElement?.children;
      deletePoint(state, slot, selected, index);
      (buttons?.[selected.value] as HTMLElement | undefined)?.focus();
      event.preventDefault();
    }
  };

  const pressed = (index: number, event: PointerEvent): void => {
    const start = map[index];
    if (event.button === 1) {
      event.preventDefault();
      deletePoint(state, slot, selected, index);
    } else if (event.button === 0 && start) {
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
      lastDrag += 1;
      selected.value = index;
      const { clientX: x, clientY: y } = event;
      drag.current = { index, gesture: `drag ${lastDrag}`, start, x, y };
    }
  };

  const moved = (event: PointerEvent): void => {
    const now = drag.current;
    if (!now) return;
    const dx = event.clientX - now.x;
    const dy = event.clientY - now.y;
    if (dx === 0 && dy === 0 && state.edit.value.gesture !== now.gesture) return;
    const value = valueAt(box, xOf(box, now.start.value) + dx);
    const begun = opacityOf(state, slot, now.start);
    const extinction =
      dy === 0 || !showsOpacity
        ? now.start.extinction
        : extinctionFor(state, slot, begun + opacityOfDrag(dy));
    const present = mapEditOf(state, slot).map;
    changeMap(state, withMovedPoint(present, now.index, value, extinction), now.gesture, slot);
  };

  const released = (): void => {
    drag.current = undefined;
    endGesture(state);
  };

  const barMiddle = kPlotHeight + kBarGap + kBarHeight / 2;
  return (
    <div class="map-points">
      {map.map((point, index) => {
        const opacity = opacityOf(state, slot, point);
        const top = showsOpacity ? yOf(Math.min(opacity, 1)) : barMiddle;
        const says = `Point ${index + 1} of ${map.length}: value ${formatValue(point.value, box.high - box.low)}, opacity ${formatNumber(100 * opacity, 3)} %`;
        return (
          <button
            key={index}
            type="button"
            class="map-point"
            data-index={index}
            data-end={isEnd(map, index) ? "" : undefined}
            aria-label={says}
            aria-pressed={index === selected.value}
            style={{ left: xOf(box, point.value), top, "--point": toHex(point.colour) }}
            onFocus={() => {
              selected.value = index;
            }}
            onKeyDown={(e) => keyDown(index, e)}
            onKeyUp={() => endGesture(state)}
            onPointerDown={(e) => pressed(index, e)}
            onPointerMove={moved}
            onPointerUp={released}
            onPointerCancel={released}
            onDblClick={(e) => {
              e.stopPropagation();
              deletePoint(state, slot, selected, index);
            }}
          />
        );
      })}
    </div>
  );
}
