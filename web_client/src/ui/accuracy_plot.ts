import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { type ChartPoint, kFloor, logRange, logTicks } from "./accuracy_points";
import { formatNumber } from "./format";

/** Where a point is, in CSS pixels from the chart's upper left corner. */
export interface Place {
  readonly left: number;
  readonly top: number;
}

const kHeight = 208;
const kFont = "11px system-ui, sans-serif";

function inks(host: HTMLElement) {
  const style = getComputedStyle(host);
  const ink = (name: string): string => style.getPropertyValue(name).trim();
  return { text: ink("--muted"), grid: ink("--plot-grid"), front: ink("--accent") };
}

/** Stairs through the points that no other beats: what an error at most costs at least. */
function drawFront(plot: uPlot, points: readonly ChartPoint[], ink: string): void {
  const front = points.filter((p) => p.row.onFront);
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  front.forEach((p, i) => {
    const x = plot.valToPos(p.ms, "x", true);
    const y = plot.valToPos(p.error, "y", true);
    if (i === 0) ctx.moveTo(x, bbox.top);
    else ctx.lineTo(x, plot.valToPos(front[i - 1]?.error ?? p.error, "y", true));
    ctx.lineTo(x, y);
    if (i === front.length - 1) ctx.lineTo(bbox.left + bbox.width, y);
  });
  ctx.strokeStyle = ink;
  ctx.lineWidth = 1.5 * devicePixelRatio;
  ctx.stroke();
  ctx.restore();
}

const placesOf = (plot: uPlot, points: readonly ChartPoint[]): Place[] =>
  points.map((p) => ({
    left: plot.bbox.left / devicePixelRatio + plot.valToPos(p.ms, "x"),
    top: plot.bbox.top / devicePixelRatio + plot.valToPos(p.error, "y"),
  }));

/** Axes, grid and front; tells where the points belong. Returns its end. */
export function drawAccuracy(
  host: HTMLElement,
  points: readonly ChartPoint[],
  drawn: (places: readonly Place[]) => void,
): () => void {
  const ink = inks(host);
  const times = logRange(points.map((p) => p.ms));
  const errors = logRange(points.map((p) => p.error));
  const axis = (label: string, ticks: number[], text: (v: number) => string): uPlot.Axis => ({
    label,
    labelFont: kFont,
    labelSize: 16,
    labelGap: 0,
    font: kFont,
    stroke: ink.text,
    grid: { stroke: ink.grid, width: 1 },
    ticks: { show: false },
    gap: 4,
    splits: () => ticks,
    filter: (_, splits) => splits,
    values: (_, splits) => splits.map(text),
  });
  const hasZero = points.some((p) => p.error === kFloor);
  const errorName = (v: number): string => (hasZero && v <= kFloor ? "0" : formatNumber(v, 1));
  const ticks = logTicks(errors, 5);
  const plot = new uPlot(
    {
      width: host.clientWidth,
      height: kHeight,
      padding: [10, 10, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, distr: 3, range: [times.low, times.high] },
        y: { distr: 3, range: [errors.low, errors.high] },
      },
      axes: [
        { ...axis("ms a picture", logTicks(times, 5), (v) => formatNumber(v, 2)), size: 20 },
        {
          ...axis(
            "error, rms, 1/255",
            hasZero ? [...ticks.filter((v) => v > 3 * kFloor), kFloor] : ticks,
            errorName,
          ),
          size: 42,
        },
      ],
      series: [{}, { paths: () => null, points: { show: false } }],
      hooks: {
        draw: [(u) => drawFront(u, points, ink.front), (u) => drawn(placesOf(u, points))],
      },
    },
    [points.map((p) => p.ms), points.map((p) => p.error)],
    host,
  );
  return () => plot.destroy();
}
