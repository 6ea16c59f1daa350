import { endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { type AxisIndex, kAxisNames } from "../state/clip_planes";
import { isRefused } from "../state/refusal";
import {
  canBeLit,
  changeLight,
  type LightNumbers,
  lightNumbers,
  moveLight,
  placeLight,
  switchLight,
} from "../state/voxel_actions";
import { formatNumber } from "./format";
import { Check, NumberField, SelectLine, SliderField } from "./inputs";

interface Props {
  readonly state: AppState;
}

const kParts: readonly (readonly [part: keyof LightNumbers, label: string, high: number])[] = [
  ["ambient", "Ambient", 1],
  ["diffuse", "Diffuse", 1],
  ["specular", "Specular", 1],
  ["exponent", "Shininess", 128],
];

const kAxes: readonly AxisIndex[] = [0, 1, 2];

/** Where the light is. */
function Place({ state }: Props) {
  const at = state.layer.value?.light?.position;
  const position = at && [at.x, at.y, at.z];
  return (
    <>
      <SelectLine
        label="Light from"
        value={at ? "point" : "eye"}
        options={[
          ["eye", "The eye"],
          ["point", "A point"],
        ]}
        take={(from) => placeLight(state, from)}
      />
      {position && (
        <div class="fields">
          {kAxes.map((axis) => (
            <NumberField
              key={axis}
              label={`Light ${kAxisNames[axis]}`}
              text={formatNumber(position[axis] ?? 0)}
              invalid={isRefused(state, "light.position")}
              take={(to) => moveLight(state, axis, to)}
            />
          ))}
        </div>
      )}
    </>
  );
}

/** Light on what a volume of voxels shows, by the gradient of its values. */
export function LightOptions({ state }: Props) {
  const layer = state.layer.value;
  if (!layer || !canBeLit(layer)) return null;
  const { light } = layer;
  const numbers = light && lightNumbers(light);
  return (
    <>
      <Check checked={light !== undefined} take={(on) => switchLight(state, on)}>
        Light
      </Check>
      {numbers &&
        kParts.map(([part, label, high]) => (
          <SliderField
            key={part}
            label={label}
            value={numbers[part]}
            low={part === "exponent" ? 1 : 0}
            high={high}
            invalid={isRefused(state, `light.${part}`)}
            take={(value, gesture) => changeLight(state, { [part]: value }, gesture)}
            done={() => endGesture(state)}
          />
        ))}
      {numbers && <Place state={state} />}
    </>
  );
}
