import type { Effect, LayerPlan, Plan } from "../net/gen/volcast/v1/session_pb";
import { isOfThisPicture, type Measured } from "../state/accuracy";
import type { AppState } from "../state/app_state";
import { formatBytes, formatCount, formatMs, formatNumber } from "./format";
import type { AppPort } from "./port";

function wayOf({ evaluator, integrator, drawnWith }: LayerPlan): string {
  const with_ = drawnWith ? `drawn with ${drawnWith}` : "";
  return [evaluator, integrator, with_].filter(Boolean).join(" · ");
}

/** What the layer was expected to take and to be off by, where that is known. */
function worthOf({ predictedMs, errorBound, stepWorld }: LayerPlan): string {
  const parts = [
    predictedMs === undefined ? "" : `${formatMs(predictedMs)} expected`,
    errorBound === undefined ? "" : `error at most ${formatNumber(errorBound, 2)}/255`,
    stepWorld > 0 ? `samples ${formatNumber(stepWorld, 3)} apart` : "",
  ];
  return parts.filter(Boolean).join(", ");
}

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

/** What an effect takes, where that was measured of this very picture. */
function timeOf(state: AppState, layer: string, effect: string): string {
  const measured = state.effectTimes.value;
  if (!measured || !isOfThisPicture(state, measured)) return "";
  const time = measured.effects.find((t) => t.layer === layer && t.effect === effect);
  if (!time || time.refusal) return time?.refusal ?? "";
  return time.ms < 0 ? `saves ${formatMs(-time.ms)}` : formatMs(time.ms);
}

interface EffectProps {
  readonly effect: Effect;
  readonly time: string;
}

function EffectItem({ effect: { name, on, reason }, time }: EffectProps) {
  return (
    <li class="effect" data-on={on ? "" : undefined}>
      <span class="effect-name">{name}</span>
      <span class="effect-ms">{time}</span>
      <span class="effect-state">{on ? "on" : "off"}</span>
      <span class="effect-reason">{reason}</span>
    </li>
  );
}

interface LayerProps {
  readonly state: AppState;
  readonly layer: LayerPlan;
  readonly only: boolean;
}

function LayerItem({ state, layer, only }: LayerProps) {
  return (
    <li>
      <h3 class="plan-way">
        {only ? "" : `${layer.layer}: `}
        {layer.drawn ? wayOf(layer) : "not drawn"}
      </h3>
      <p class="hint">{worthOf(layer)}</p>
      <ul class="effects">
        {layer.effects.map((effect) => (
          <EffectItem
            key={effect.name}
            effect={effect}
            time={timeOf(state, layer.layer, effect.name)}
          />
        ))}
      </ul>
    </li>
  );
}

function timesOf({ timings, work }: Plan): readonly (readonly [string, string])[] {
  return [
    ["Wait", formatMs(timings?.waitMs ?? 0)],
    ["Upload", formatMs(timings?.uploadMs ?? 0)],
    ["Draw", formatMs(timings?.drawMs ?? 0)],
    ["Read back", formatMs(timings?.readbackMs ?? 0)],
    ["Uploaded", formatBytes(Number(work?.uploadedBytes ?? 0n))],
    ["Programs built", formatCount(Number(work?.programsBuilt ?? 0n))],
    ["Draw calls", formatCount(Number(work?.drawCalls ?? 0n))],
  ];
}

function effectsSaid(state: AppState, measured: Measured | undefined): string {
  if (!measured || !isOfThisPicture(state, measured)) {
    return "Effects are measured by drawing without each of them.";
  }
  if (measured.running) return "";
  if (measured.stopped) return `Stopped: ${measured.stopped}.`;
  return `Of ${formatMs(measured.pictureMs)} that this picture takes, medians of seven.`;
}

/** Measures, on request, what the effects of this picture take. */
function EffectTimes({ state, port }: Props) {
  const measured = state.effectTimes.value;
  const running = measured?.running ?? false;
  return (
    <div class="effect-times">
      <p class="hint" role="status">
        {effectsSaid(state, measured)}
      </p>
      {running && (
        <progress aria-label="Measuring effects" max={1} value={measured?.progress ?? 0} />
      )}
      <button
        type="button"
        class="text-button"
        onClick={running ? port.stopMeasuring : () => port.measure("effectTimes")}
      >
        {running ? "Stop" : "Measure the effects"}
      </button>
    </div>
  );
}

/** The server's plan of the newest picture: by layer what is on or off and why, then the times. */
export function PlanList({ state, port }: Props) {
  const plan = state.plan.value;
  if (!plan) return null;
  return (
    <div class="plan" data-input-seq={String(plan.inputSeq)}>
      <ul>
        {plan.layers.map((layer) => (
          <LayerItem
            key={layer.layer}
            state={state}
            layer={layer}
            only={plan.layers.length === 1}
          />
        ))}
      </ul>
      <EffectTimes state={state} port={port} />
      <h3 class="plan-way">This picture took</h3>
      <dl class="plan-times">
        {timesOf(plan).map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}
