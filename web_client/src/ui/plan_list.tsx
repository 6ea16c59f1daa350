import type { Effect, LayerPlan, Plan } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "../state/app_state";
import { formatBytes, formatCount, formatMs, formatNumber } from "./format";

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

function EffectItem({ name, on, reason }: Effect) {
  return (
    <li class="effect" data-on={on ? "" : undefined}>
      <span class="effect-name">{name}</span>
      <span class="effect-state">{on ? "on" : "off"}</span>
      <span class="effect-reason">{reason}</span>
    </li>
  );
}

function LayerItem({ layer, only }: { readonly layer: LayerPlan; readonly only: boolean }) {
  return (
    <li>
      <h3 class="plan-way">
        {only ? "" : `${layer.layer}: `}
        {layer.drawn ? wayOf(layer) : "not drawn"}
      </h3>
      <p class="hint">{worthOf(layer)}</p>
      <ul class="effects">
        {layer.effects.map((effect) => (
          <EffectItem key={effect.name} {...effect} />
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

/** The server's plan of the newest picture: by layer what is on or off and why, then the times. */
export function PlanList({ state }: { readonly state: AppState }) {
  const plan = state.plan.value;
  if (!plan) return null;
  return (
    <div class="plan" data-input-seq={String(plan.inputSeq)}>
      <ul>
        {plan.layers.map((layer) => (
          <LayerItem key={layer.layer} layer={layer} only={plan.layers.length === 1} />
        ))}
      </ul>
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
