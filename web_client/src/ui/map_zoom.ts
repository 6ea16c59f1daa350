import type { PlotBox } from "./map_plot";

/** The part of an editor's whole range that is shown, along its axis: 0 to 1. */
export interface Zoom {
  readonly from: number;
  readonly to: number;
}

export const kWhole: Zoom = { from: 0, to: 1 };
const kSmallest = 1e-4;

/** Kept within the whole. */
function placed(from: number, span: number): Zoom {
  const size = Math.min(1, Math.max(kSmallest, span));
  const start = Math.min(1 - size, Math.max(0, from));
  return size === 1 ? kWhole : { from: start, to: start + size };
}

/** `factor` > 1 shows less; what is at `at`, from 0 to 1 of what is shown, stays there. */
export function zoomed({ from, to }: Zoom, factor: number, at: number): Zoom {
  const before = to - from;
  const span = Math.min(1, Math.max(kSmallest, before / factor));
  return placed(from + at * (before - span), span);
}

/** Moved by a share of what is shown. */
export function panned({ from, to }: Zoom, by: number): Zoom {
  return placed(from + by * (to - from), to - from);
}

/** The box that is shown of `box`. */
export function boxWithin(box: PlotBox, { from, to }: Zoom): PlotBox {
  const { along, back } = box.axis;
  const start = along(box.low);
  const span = along(box.high) - start;
  const low = from === 0 ? box.low : back(start + from * span);
  const high = to === 1 ? box.high : back(start + to * span);
  return high > low ? { ...box, low, high } : box;
}
