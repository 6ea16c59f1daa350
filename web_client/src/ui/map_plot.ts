import { type Axis, kStraight } from "../transfer/scale";
import { toHex } from "../transfer/srgb";
import { sampleAt, type TransferFunction } from "../transfer/transfer_function";

/** The editor's box in CSS pixels: the curve above, the colour bar below. */
export interface PlotBox {
  readonly width: number;
  readonly low: number;
  readonly high: number;
  /** How values lie between both. */
  readonly axis: Axis;
}

export const kPlotHeight = 136;
export const kBarGap = 10;
export const kBarHeight = 14;
export const kPadX = 10;
const kPadTop = 10;

export function xOf(box: PlotBox, value: number): number {
  const { along } = box.axis;
  const t = (along(value) - along(box.low)) / (along(box.high) - along(box.low));
  return kPadX + t * (box.width - 2 * kPadX);
}

export function valueAt(box: PlotBox, x: number): number {
  const t = Math.min(1, Math.max(0, (x - kPadX) / (box.width - 2 * kPadX)));
  if (t === 0 || t === 1) return t === 0 ? box.low : box.high;
  const { along, back } = box.axis;
  return back(along(box.low) + t * (along(box.high) - along(box.low)));
}

export function yOf(opacity: number): number {
  return kPadTop + (1 - opacity) * (kPlotHeight - kPadTop);
}

/** How far a drag of `dy` CSS pixels changes the opacity. */
export function opacityOfDrag(dy: number): number {
  return -dy / (kPlotHeight - kPadTop);
}

/** The range that the editor shows: the field's and the map's, within what the axis can show. */
export function rangeOf(
  map: TransferFunction,
  fieldMin: number,
  fieldMax: number,
  axis: Axis = kStraight,
): { low: number; high: number } {
  const low = Math.max(axis.low, Math.min(fieldMin, map[0]?.value ?? fieldMin));
  const high = Math.min(axis.high, Math.max(fieldMax, map[map.length - 1]?.value ?? fieldMax));
  return high > low ? { low, high } : { low: low - 0.5, high: high + 0.5 };
}

/** Heights in [0, 1] of the histogram's bars; counts differ by powers, so usually by logarithm. */
export function barHeights(counts: readonly number[], log = true): number[] {
  const sizes = log ? counts.map(Math.log1p) : counts;
  const most = Math.max(0, ...sizes);
  return sizes.map((size) => (most > 0 ? size / most : 0));
}

export interface PlotContent {
  readonly box: PlotBox;
  /** With the density that is drawn. */
  readonly map: TransferFunction;
  /** What is drawn of a point's extinction, from 0 to 1. */
  readonly opacityOf: (extinction: number) => number;
  readonly histogram: readonly number[];
  readonly histogramRange: { readonly min: number; readonly max: number };
  /** Bars by the logarithm of their counts; where absent, too. */
  readonly logCounts?: boolean;
  readonly showsOpacity: boolean;
  readonly showsColours: boolean;
}

interface Inks {
  readonly bars: string;
  readonly grid: string;
  readonly curve: string;
  /** For maps whose colours play no part. */
  readonly grey: string;
}

function drawGrid(context: CanvasRenderingContext2D, { box }: PlotContent, ink: string): void {
  context.fillStyle = ink;
  for (const opacity of [0, 0.25, 0.5, 0.75, 1]) {
    context.fillRect(kPadX, Math.round(yOf(opacity)) - 0.5, box.width - 2 * kPadX, 1);
  }
}

function drawHistogram(context: CanvasRenderingContext2D, content: PlotContent, ink: string): void {
  const { box, histogram } = content;
  const { min, max } = content.histogramRange;
  const bin = (max - min) / histogram.length;
  if (!(bin > 0)) return;
  context.fillStyle = ink;
  context.beginPath(); // One shape: bars that meet leave no seam.
  barHeights(histogram, content.logCounts).forEach((height, i) => {
    const left = xOf(box, min + i * bin);
    const right = xOf(box, min + (i + 1) * bin);
    if (right < kPadX || left > box.width - kPadX) return; // Beyond what is shown.
    const top = yOf(0.92 * height);
    context.rect(left, top, right - left, kPlotHeight - top);
  });
  context.fill();
}

/** One column a device pixel: colour and opacity as they are, curved where the map is straight. */
function drawMap(
  context: CanvasRenderingContext2D,
  content: PlotContent,
  scale: number,
  ink: string,
): void {
  const { box, map, opacityOf, showsOpacity, showsColours } = content;
  const step = 1 / scale;
  for (let x = kPadX; x < box.width - kPadX; x += step) {
    const here = sampleAt(map, valueAt(box, x + step / 2), box.axis.along);
    context.fillStyle = showsColours ? toHex(here.colour) : ink;
    context.fillRect(x, kPlotHeight + kBarGap, step, kBarHeight);
    if (!showsOpacity) continue;
    const top = yOf(opacityOf(here.extinction));
    context.globalAlpha = 0.5;
    context.fillRect(x, top, step, kPlotHeight - top);
    context.globalAlpha = 1;
  }
}

function drawCurve(context: CanvasRenderingContext2D, content: PlotContent, ink: string): void {
  const { box, map, opacityOf } = content;
  context.strokeStyle = ink;
  context.lineWidth = 1.5;
  context.lineJoin = "round";
  context.beginPath();
  const lineTo = (x: number, extinction: number): void =>
    context.lineTo(x, yOf(opacityOf(extinction)));
  const first = xOf(box, map[0]?.value ?? box.low);
  if (first > kPadX) lineTo(kPadX, map[0]?.extinction ?? 0);
  map.forEach((point, i) => {
    const before = map[i - 1];
    const x = xOf(box, point.value);
    for (let k = 1; before && k < 16; k += 1) {
      const from = xOf(box, before.value);
      const extinction = before.extinction + ((point.extinction - before.extinction) * k) / 16;
      lineTo(from + ((x - from) * k) / 16, extinction);
    }
    lineTo(x, point.extinction);
  });
  lineTo(
    Math.max(box.width - kPadX, xOf(box, map[map.length - 1]?.value ?? box.high)),
    map[map.length - 1]?.extinction ?? 0,
  );
  context.stroke();
}

/** Draws the whole plot at `scale` device pixels a CSS pixel. */
export function drawPlot(canvas: HTMLCanvasElement, content: PlotContent, scale: number): void {
  const height = kPlotHeight + kBarGap + kBarHeight;
  canvas.width = Math.round(content.box.width * scale);
  canvas.height = Math.round(height * scale);
  const context = canvas.getContext("2d");
  if (!context) return;
  const style = getComputedStyle(canvas);
  const inks: Inks = {
    bars: style.getPropertyValue("--plot-bars"),
    grid: style.getPropertyValue("--plot-grid"),
    curve: style.getPropertyValue("--plot-curve"),
    grey: style.getPropertyValue("--line-strong"),
  };
  context.setTransform(scale, 0, 0, scale, 0, 0);
  drawGrid(context, content, inks.grid);
  context.beginPath();
  context.rect(kPadX, 0, content.box.width - 2 * kPadX, height);
  context.clip();
  drawHistogram(context, content, inks.bars);
  drawMap(context, content, scale, inks.grey);
  if (content.showsOpacity) drawCurve(context, content, inks.curve);
}
