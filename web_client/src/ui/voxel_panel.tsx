import { Integrator, RayModel, Sampling, VoxelEvaluator } from "../net/gen/volcast/v1/scene_pb";
import { changeLayer, endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { kIntegratorLabels, voxelIntegratorsOf } from "../state/models";
import { isRefused } from "../state/refusal";
import {
  canBeSliced,
  changeSeed,
  chooseStep,
  isAbsorbing,
  isVolume,
  type StepKind,
  stepKindOf,
  switchJitter,
} from "../state/voxel_actions";
import { formatNumber } from "./format";
import { Check, NumberLine, SelectLine, SliderField } from "./inputs";
import { LightOptions } from "./light_options";

interface Props {
  readonly state: AppState;
}

const kSteps: readonly (readonly [StepKind, string])[] = [
  ["usual", "Half a voxel apart"],
  ["length", "By their distance"],
  ["count", "By their number"],
];

/** How far apart a ray's samples are; `usual`: how the server chooses by itself. */
export function StepOptions({ state, usual }: Props & { readonly usual?: string }) {
  const layer = state.layer.value;
  if (!layer) return null;
  const kind = stepKindOf(layer);
  const options = kSteps.map(([k, text]) => [k, (k === "usual" && usual) || text] as const);
  return (
    <>
      <SelectLine
        label="Samples"
        value={kind}
        options={options}
        invalid={isRefused(state, "step_world") || isRefused(state, "depth_samples")}
        take={(next) => chooseStep(state, next)}
      />
      {kind === "length" && (
        <NumberLine
          label="Step, world units"
          text={formatNumber(layer.stepWorld)}
          invalid={isRefused(state, "step_world")}
          take={(stepWorld) => changeLayer(state, { stepWorld })}
        />
      )}
      {kind === "count" && (
        <NumberLine
          label="Samples over the depth"
          text={String(layer.depthSamples)}
          invalid={isRefused(state, "depth_samples")}
          take={(count) =>
            changeLayer(state, { depthSamples: Math.round(Math.min(1e6, Math.max(1, count))) })
          }
        />
      )}
    </>
  );
}

/** How what lies between two samples is added up; code and several channels have one way. */
function IntegratorOption({ state }: Props) {
  const layer = state.layer.value;
  const integrators = layer ? voxelIntegratorsOf(layer.model) : [];
  if (!layer || layer.shader?.code || layer.channels.length > 0) return null;
  if (integrators.length === 0) return null;
  return (
    <SelectLine
      label="Integrator"
      value={layer.integrator}
      options={[
        [Integrator.AUTO, kIntegratorLabels[Integrator.AUTO]],
        ...integrators.map((i) => [i, kIntegratorLabels[i]] as const),
      ]}
      invalid={isRefused(state, "integrator")}
      take={(integrator) => changeLayer(state, { integrator })}
    />
  );
}

const kEvaluators: readonly (readonly [VoxelEvaluator, string])[] = [
  [VoxelEvaluator.AUTO, "Whatever is faster"],
  [VoxelEvaluator.MARCH, "Rays that march"],
  [VoxelEvaluator.SLICES, "Slices across the view"],
  [VoxelEvaluator.SLICE_INSTANCES, "Slices, as instances"],
];

/** What brings rays and voxels together. */
function EvaluatorOption({ state }: Props) {
  const layer = state.layer.value;
  if (!layer || !canBeSliced(layer)) return null;
  return (
    <SelectLine
      label="Drawn by"
      value={layer.voxelEvaluator}
      options={kEvaluators}
      invalid={isRefused(state, "voxel_evaluator")}
      take={(voxelEvaluator) => changeLayer(state, { voxelEvaluator })}
    />
  );
}

/** Where samples lie in their steps; code has them in the middle. */
function JitterOptions({ state }: Props) {
  const layer = state.layer.value;
  if (!layer || layer.shader?.code) return null;
  const seed = layer.jitter;
  return (
    <>
      <Check checked={seed !== undefined} take={(on) => switchJitter(state, on)}>
        Jitter: noise instead of bands
      </Check>
      {seed !== undefined && (
        <NumberLine
          label="Seed"
          text={String(seed)}
          invalid={isRefused(state, "jitter")}
          take={(next) => changeSeed(state, next)}
        />
      )}
    </>
  );
}

/** How a volume of voxels is sampled and lit. */
export function VoxelPanel({ state }: Props) {
  const layer = state.layer.value;
  if (!layer || !isVolume(state)) return null;
  return (
    <section class="section" aria-labelledby="voxels-heading">
      <h2 id="voxels-heading">Voxels</h2>
      <div class="options">
        <SelectLine
          label="Between voxels"
          value={layer.sampling}
          options={[
            [Sampling.TRILINEAR, "Linear"],
            [Sampling.TRICUBIC, "Cubic"],
            [Sampling.NEAREST, "Nearest voxel"],
          ]}
          take={(sampling) => changeLayer(state, { sampling })}
        />
        {layer.model !== RayModel.CROSS_SECTIONS && (
          <>
            <EvaluatorOption state={state} />
            <StepOptions state={state} />
            <JitterOptions state={state} />
          </>
        )}
        <IntegratorOption state={state} />
        {isAbsorbing(layer) && (
          <SliderField
            label="Gain"
            value={layer.gain}
            low={-10}
            high={10}
            invalid={isRefused(state, "gain")}
            take={(gain, gesture) => changeLayer(state, { gain }, gesture)}
            done={() => endGesture(state)}
          />
        )}
        <LightOptions state={state} />
      </div>
    </section>
  );
}
