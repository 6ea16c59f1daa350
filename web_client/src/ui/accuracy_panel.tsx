import { create } from "@bufbuild/protobuf";
import {
  Accuracy_Kind,
  AccuracySchema,
  Integrator,
  RayModel,
} from "../net/gen/volcast/v1/scene_pb";
import { hasChoice } from "../state/accuracy_stops";
import { changeLayer, changeScene, isMesh } from "../state/actions";
import type { AppState } from "../state/app_state";
import {
  evaluatorsOf,
  factsOf,
  fittedTo,
  kEvaluatorLabels,
  kIntegratorLabels,
} from "../state/models";
import { isRefused } from "../state/refusal";
import { formatNumber } from "./format";
import { NumberLine, SelectLine } from "./inputs";
import { lazy } from "./lazy";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
}

const AccuracySlider = lazy(async () => (await import("./accuracy_slider")).AccuracySlider);

const kWishes: readonly (readonly [Accuracy_Kind, string])[] = [
  [Accuracy_Kind.AUTO, "Automatic"],
  [Accuracy_Kind.FASTEST, "Fastest"],
  [Accuracy_Kind.EXACT, "Exact"],
  [Accuracy_Kind.ERROR_BOUND, "Error at most"],
  [Accuracy_Kind.TIME_BUDGET, "Time at most"],
];

const kBounds = {
  [Accuracy_Kind.ERROR_BOUND]: { label: "Error, in 1/255", start: 1 },
  [Accuracy_Kind.TIME_BUDGET]: { label: "Time, ms a picture", start: 50 },
} as const;

const isBounded = (kind: Accuracy_Kind): kind is keyof typeof kBounds => kind in kBounds;

function Wish({ state }: Props) {
  const wish = state.scene.value?.accuracy ?? create(AccuracySchema);
  const set = (kind: Accuracy_Kind, bound: number): void =>
    changeScene(state, { accuracy: create(AccuracySchema, { kind, bound }) });
  const { kind } = wish;
  return (
    <>
      <SelectLine
        label="Wish"
        value={kind}
        options={kWishes}
        invalid={isRefused(state, "accuracy")}
        take={(next) => set(next, isBounded(next) ? kBounds[next].start : 0)}
      />
      {isBounded(kind) && (
        <NumberLine
          label={kBounds[kind].label}
          text={formatNumber(wish.bound)}
          invalid={isRefused(state, "accuracy.bound")}
          take={(bound) => set(kind, bound)}
        />
      )}
    </>
  );
}

/** By name, for those who know which one they want. */
function Choices({ state }: Props) {
  const layer = state.layer.value;
  if (!layer) return null;
  const model = layer.model || RayModel.VOLUME;
  const { integrators } = factsOf(model);
  const evaluators = evaluatorsOf(model, layer.integrator);
  const choose = (integrator: Integrator): void =>
    changeLayer(state, fittedTo({ ...layer, integrator }, model));
  const both = [Integrator.AUTO, ...integrators];
  return (
    <details class="advanced">
      <summary>By name</summary>
      <div class="options">
        {integrators.length > 1 && (
          <SelectLine
            label="Integrator"
            value={layer.integrator}
            options={both.map((i) => [i, kIntegratorLabels[i]] as const)}
            invalid={isRefused(state, "integrator")}
            take={choose}
          />
        )}
        {evaluators.length > 1 && (
          <SelectLine
            label="Evaluator"
            value={layer.evaluator}
            options={evaluators.map((e) => [e, kEvaluatorLabels[e]] as const)}
            invalid={isRefused(state, "evaluator")}
            take={(evaluator) => changeLayer(state, { evaluator })}
          />
        )}
        {integrators.length === 1 && evaluators.length === 1 && (
          <p class="hint">This ray model is drawn in one way, an exact one.</p>
        )}
      </div>
    </details>
  );
}

/** What a picture is to be worth. */
export function AccuracyPanel({ state, port }: Props & { readonly port: AppPort }) {
  const layer = state.layer.value;
  if (!layer || layer.shader?.code) return null; // Code has one way.
  return (
    <section class="section" aria-labelledby="accuracy-heading">
      <h2 id="accuracy-heading">Accuracy</h2>
      <div class="options">
        {hasChoice(state) && <AccuracySlider state={state} port={port} />}
        <Wish state={state} />
        {isMesh(state) && <Choices state={state} />}
      </div>
    </section>
  );
}
