import { RayModel } from "../net/gen/volcast/v1/scene_pb";
import { changeLayer, endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { chooseSecondField } from "../state/layer_actions";
import { factsOf } from "../state/models";
import { isRefused } from "../state/refusal";
import { formatNumber } from "./format";
import { Check, ColourLine, NumberLine, SelectLine, SliderField } from "./inputs";

interface Props {
  readonly state: AppState;
}

const kLightGrey = { r: 0.8, g: 0.8, b: 0.8 };
const kBlack = { r: 0, g: 0, b: 0 };

function EdgeOptions({ state }: Props) {
  const layer = state.layer.value;
  if (!layer) return null;
  return (
    <>
      <NumberLine
        label="Edge width, pixels"
        text={formatNumber(layer.edgeWidth ?? 1)}
        invalid={isRefused(state, "edge_width")}
        take={(edgeWidth) => changeLayer(state, { edgeWidth })}
      />
      <ColourLine
        label="Edge colour"
        colour={layer.edgeColour ?? kBlack}
        take={(edgeColour, gesture) => changeLayer(state, { edgeColour }, gesture)}
        done={() => endGesture(state)}
      />
    </>
  );
}

/** How what is solid looks: its colour, a headlight, its edges. */
export function SurfaceOptions({ state }: Props) {
  const layer = state.layer.value;
  if (!layer || !factsOf(layer.model).lit) return null;
  const boundary = layer.model !== RayModel.ISOSURFACE;
  return (
    <>
      {boundary && (
        <Check checked={layer.coloured} take={(coloured) => changeLayer(state, { coloured })}>
          Coloured by the field
        </Check>
      )}
      <Check checked={!layer.unlit} take={(lit) => changeLayer(state, { unlit: !lit })}>
        Headlight
      </Check>
      {boundary && !layer.coloured && (
        <ColourLine
          label="Colour"
          colour={layer.surfaceColour ?? kLightGrey}
          take={(surfaceColour, gesture) => changeLayer(state, { surfaceColour }, gesture)}
          done={() => endGesture(state)}
        />
      )}
      {layer.model === RayModel.WIREFRAME && <EdgeOptions state={state} />}
    </>
  );
}

/** What is multiplied to what a ray adds up. */
export function LineOptions({ state }: Props) {
  const layer = state.layer.value;
  if (layer?.model === RayModel.XRAY) {
    return (
      <NumberLine
        label="Strength, times the map’s"
        text={formatNumber(layer.extinctionScale ?? 1)}
        invalid={isRefused(state, "extinction_scale")}
        take={(extinctionScale) => changeLayer(state, { extinctionScale })}
      />
    );
  }
  if (layer?.model !== RayModel.SPLAT) return null;
  return (
    <SliderField
      label="Exposure"
      value={layer.exposure}
      low={-8}
      high={8}
      invalid={isRefused(state, "exposure")}
      take={(exposure, gesture) => changeLayer(state, { exposure }, gesture)}
      done={() => endGesture(state)}
    />
  );
}

/** Takes density or colour from another field. */
export function SecondField({ state }: Props) {
  const layer = state.layer.value;
  const part = layer && factsOf(layer.model).second;
  const fields = (state.dataset.value?.fields ?? []).filter(
    (f) => f.name !== state.field.value?.name,
  );
  if (!layer || !part || fields.length === 0) return null;
  const same = part === "density" ? "The field itself" : "The level";
  return (
    <SelectLine
      label={part === "density" ? "Density from" : "Colour from"}
      value={layer.densityField}
      options={[["", same], ...fields.map((f) => [f.name, f.name] as const)]}
      invalid={isRefused(state, "density_field")}
      take={(name) => chooseSecondField(state, name)}
    />
  );
}
