import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { isOfThisPicture } from "../state/accuracy";
import type { AppState } from "../state/app_state";
import type { Difference, Figures } from "../state/difference";
import { paintDifference, scaleColour } from "./difference_paint";
import { formatCount, formatNumber } from "./format";
import { IconButton } from "./icons";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

/** The scale ends at 2 to the power of these, in 1/255. */
const kLeastPower = -8;
const kMostPower = 8;

const kGradient = `linear-gradient(to right, ${Array.from({ length: 17 }, (_, i) => scaleColour(i / 16)).join(", ")})`;

function Picture({ difference, range }: { difference: Difference; range: number }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { width, height, off } = difference;
  useLayoutEffect(() => {
    const pixels = new ImageData(paintDifference(off, range), width, height);
    canvas.current?.getContext("2d")?.putImageData(pixels, 0, 0);
  }, [difference, range]);
  return (
    <canvas
      ref={canvas}
      class="difference-picture"
      width={width}
      height={height}
      role="img"
      aria-label="Difference from the reference"
      data-step={difference.step}
      data-done={difference.running ? undefined : ""}
    />
  );
}

const inSteps = (error: number): string => (error === 0 ? "0" : formatNumber(255 * error, 3));

function FigureList({ figures }: { readonly figures: Figures }) {
  const share = figures.shareOver255;
  return (
    <dl class="difference-figures">
      <div>
        <dt>Largest</dt>
        <dd data-figure="max">{inSteps(figures.max)}</dd>
      </div>
      <div>
        <dt>RMS</dt>
        <dd data-figure="rms">{inSteps(figures.rms)}</dd>
      </div>
      <div>
        <dt>Over 1</dt>
        <dd data-figure="share">{share === 0 ? "0" : formatNumber(100 * share, 3)} %</dd>
      </div>
      <div>
        <dt>Pixels</dt>
        <dd data-figure="pixels">{formatCount(figures.pixels)}</dd>
      </div>
    </dl>
  );
}

/** What the colours stand for, and how far; the end of the scale can be moved. */
function Legend({ state, port }: Props) {
  // On a narrow screen it would hide most of what it explains.
  const isRoomy = useSignal(matchMedia("(min-width: 720px)").matches);
  const range = state.differenceRange.value;
  const difference = state.difference.value;
  const now = difference && isOfThisPicture(state, difference) ? difference : undefined;
  const { figures } = now ?? {};
  const end = formatNumber(range, 3);
  return (
    <section class="difference-legend" aria-label="Scale of the difference">
      <header>
        <span>
          Difference in 1/255 of white,{" "}
          <abbr title="Before sRGB encoding, premultiplied, without background: the channel that is off most">
            linear light
          </abbr>
        </span>
        <IconButton icon="close" label="Hide the difference" onClick={() => port.compare(false)} />
      </header>
      <div class="difference-bar" style={{ backgroundImage: kGradient }} />
      <div class="difference-ticks" aria-hidden="true">
        <span>0</span>
        <span>{formatNumber(range / 2, 3)}</span>
        <span>{end} and more</span>
      </div>
      {!figures && <p class="difference-waits">Waits for the exact picture.</p>}
      <details open={isRoomy.value}>
        <summary>Scale and figures</summary>
        <label class="difference-range">
          <span>Scale ends at</span>
          <input
            type="range"
            min={kLeastPower}
            max={kMostPower}
            step={0.5}
            value={Math.log2(range)}
            aria-valuetext={`${end} of 255`}
            onInput={(e) => {
              state.differenceRange.value = 2 ** Number(e.currentTarget.value);
            }}
          />
        </label>
        {figures && <FigureList figures={figures} />}
      </details>
      {now?.running && <progress aria-label="Compared so far" max={1} value={now.progress} />}
      {now && !now.running && now.step > 1 && (
        <p>Each square of {now.step} pixels by one of them.</p>
      )}
    </section>
  );
}

/** The picture's difference from the reference, over the picture; gone while the view changes. */
export function DifferenceOverlay({ state, port }: Props) {
  const difference = state.difference.value;
  const shown = difference && difference.width > 0 && isOfThisPicture(state, difference);
  return (
    <div class="difference">
      {shown && <Picture difference={difference} range={state.differenceRange.value} />}
      <Legend state={state} port={port} />
    </div>
  );
}
