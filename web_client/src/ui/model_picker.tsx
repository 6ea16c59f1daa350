import { RayModel, Sampling } from "../net/gen/volcast/v1/scene_pb";
import { DatasetKind } from "../net/gen/volcast/v1/session_pb";
import { changeField, changeLayer, changeScene, modelsOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import { fromHex, toHex } from "../transfer/srgb";

interface Props {
  readonly state: AppState;
}

const kLightGrey = { r: 0.8, g: 0.8, b: 0.8 };
const kBlack = { r: 0, g: 0, b: 0 };

function nameOf(model: RayModel, kind: DatasetKind): string {
  const voxels = kind === DatasetKind.VOLUME;
  if (model === RayModel.SURFACE) return "Surface";
  if (model === RayModel.MIP) return voxels ? "Maximum (MAX)" : "Maximum";
  return voxels ? "Volume (ON)" : "Volume";
}

const kMeaning: Readonly<Record<RayModel, string>> = {
  [RayModel.UNSPECIFIED]: "",
  [RayModel.SURFACE]: "The nearest boundary of the data.",
  [RayModel.MIP]: "The colour of the largest value along each ray.",
  [RayModel.VOLUME]: "Light emitted and absorbed along each ray.",
};

function SurfaceOptions({ state }: Props) {
  const layer = state.layer.value;
  if (!layer) return null;
  const colour = layer.surfaceColour ?? kLightGrey;
  return (
    <div class="options">
      <label class="check">
        <input
          type="checkbox"
          checked={layer.coloured}
          onChange={(e) => changeLayer(state, { coloured: e.currentTarget.checked })}
        />
        Coloured by the field
      </label>
      <label class="check">
        <input
          type="checkbox"
          checked={!layer.unlit}
          onChange={(e) => changeLayer(state, { unlit: !e.currentTarget.checked })}
        />
        Headlight
      </label>
      {!layer.coloured && (
        <label class="line">
          <span>Colour</span>
          <input
            type="color"
            value={toHex(colour)}
            onInput={(e) => {
              const picked = fromHex(e.currentTarget.value);
              const message = picked && { $typeName: "volcast.v1.Colour" as const, ...picked };
              if (message) changeLayer(state, { surfaceColour: message });
            }}
          />
        </label>
      )}
    </div>
  );
}

function SamplingOption({ state }: Props) {
  return (
    <label class="line">
      <span>Between voxels</span>
      <select
        value={String(state.layer.value?.sampling ?? Sampling.TRILINEAR)}
        onChange={(e) => changeLayer(state, { sampling: Number(e.currentTarget.value) })}
      >
        <option value={String(Sampling.TRILINEAR)}>Linear</option>
        <option value={String(Sampling.NEAREST)}>Nearest voxel</option>
      </select>
    </label>
  );
}

/** How a ray turns data into colour, with the options of the chosen model. */
export function ModelPicker({ state }: Props) {
  const kind = state.dataset.value?.kind ?? DatasetKind.UNKNOWN;
  const current = state.layer.value?.model || RayModel.VOLUME;
  const models = modelsOf(state);
  if (!state.layer.value || models.length === 0) return null;
  return (
    <section class="section" aria-labelledby="model-heading">
      <h2 id="model-heading">Ray model</h2>
      <div class="segments" role="radiogroup" aria-labelledby="model-heading">
        {models.map((model) => (
          <label key={model} class="segment">
            <input
              type="radio"
              name="model"
              value={String(model)}
              checked={model === current}
              onChange={() => changeLayer(state, { model })}
            />
            <span>{nameOf(model, kind)}</span>
          </label>
        ))}
      </div>
      <p class="hint">{kMeaning[current]}</p>
      {current === RayModel.SURFACE && <SurfaceOptions state={state} />}
      {kind === DatasetKind.VOLUME && <SamplingOption state={state} />}
    </section>
  );
}

/** Which of the dataset's fields is shown. */
export function FieldPicker({ state }: Props) {
  const fields = state.dataset.value?.fields ?? [];
  const field = state.field.value;
  if (!field || !state.scene.value) return null;
  return (
    <section class="section" aria-labelledby="field-heading">
      <div class="line">
        <h2 id="field-heading">Field</h2>
        {fields.length > 1 ? (
          <select
            class="grow"
            aria-labelledby="field-heading"
            value={field.name}
            onChange={(e) => changeField(state, e.currentTarget.value)}
          >
            {fields.map((f) => (
              <option key={f.name} value={f.name}>
                {f.name}
              </option>
            ))}
          </select>
        ) : (
          <span class="only">{field.name}</span>
        )}
      </div>
    </section>
  );
}

/** What lies behind the data. */
export function BackgroundPicker({ state }: Props) {
  const scene = state.scene.value;
  if (!scene) return null;
  return (
    <section class="section" aria-label="Background">
      <label class="line">
        <span>Background</span>
        <input
          type="color"
          value={toHex(scene.background ?? kBlack)}
          onInput={(e) => {
            const picked = fromHex(e.currentTarget.value);
            const message = picked && { $typeName: "volcast.v1.Colour" as const, ...picked };
            if (message) changeScene(state, { background: message });
          }}
        />
      </label>
    </section>
  );
}
