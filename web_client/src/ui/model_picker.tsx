import { useEffect, useRef } from "preact/hooks";
import { RayModel } from "../net/gen/volcast/v1/scene_pb";
import { DatasetKind } from "../net/gen/volcast/v1/session_pb";
import { isMesh, modelsOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import { chooseModel } from "../state/layer_actions";
import { factsOf } from "../state/models";
import { switched } from "../state/view_options";
import { lazy } from "./lazy";
import { LevelOptions } from "./level_options";
import { LineOptions, SecondField, SurfaceOptions } from "./model_options";
import { SectionOptions } from "./section_options";

interface Props {
  readonly state: AppState;
}

const ModelThumb = lazy(async () => (await import("./model_thumb")).ModelThumb);

/** Keeps `state.pictured` at the models whose thumbnails are on the screen. */
function usePictured(state: AppState, models: readonly RayModel[], on: boolean) {
  const list = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!on || !list.current) return undefined;
    const sight = new IntersectionObserver((entries) => {
      const seen = entries.some((entry) => entry.isIntersecting);
      state.pictured.value = seen ? models : [];
    });
    sight.observe(list.current);
    return () => {
      sight.disconnect();
      state.pictured.value = [];
    };
  }, [on, models.join()]);
  return list;
}

function nameOf(model: RayModel, kind: DatasetKind): string {
  const { name } = factsOf(model);
  if (kind !== DatasetKind.VOLUME) return name;
  if (model === RayModel.MIP) return `${name} (MAX)`;
  if (model === RayModel.CROSS_SECTIONS) return `${name} (OFF)`;
  return model === RayModel.VOLUME ? `${name} (ON)` : name;
}

/** How a ray turns data into colour, with the options of the chosen model. */
export function ModelPicker({ state }: Props) {
  const kind = state.dataset.value?.kind ?? DatasetKind.UNKNOWN;
  const current = state.layer.value?.model || RayModel.VOLUME;
  const models = modelsOf(state);
  const pictures = state.options.value.thumbnails;
  const list = usePictured(state, models, pictures && models.length > 0);
  if (!state.layer.value || models.length === 0) return null;
  return (
    <section class="section" aria-labelledby="model-heading">
      <div class="section-head">
        <h2 id="model-heading">Ray model</h2>
        <button
          type="button"
          class="text-button"
          aria-pressed={pictures}
          onClick={() => {
            state.options.value = switched(state.options.value, "thumbnails");
          }}
        >
          Pictures
        </button>
      </div>
      <div
        ref={list}
        class="segments"
        data-pictures={pictures ? "" : undefined}
        data-many={models.length > 3 ? "" : undefined}
        role="radiogroup"
        aria-labelledby="model-heading"
      >
        {models.map((model) => (
          <label key={model} class="segment" title={factsOf(model).meaning}>
            <input
              type="radio"
              name="model"
              value={String(model)}
              checked={model === current}
              onChange={() => chooseModel(state, model)}
            />
            {pictures && <ModelThumb state={state} model={model} />}
            <span>{nameOf(model, kind)}</span>
          </label>
        ))}
      </div>
      <p class="hint">{factsOf(current).meaning}</p>
      <div class="options">
        {current === RayModel.ISOSURFACE && <LevelOptions state={state} />}
        <SurfaceOptions state={state} />
        <LineOptions state={state} />
        {isMesh(state) && <SecondField state={state} />}
        <SectionOptions state={state} />
      </div>
    </section>
  );
}
