import { create } from "@bufbuild/protobuf";
import { type InvlerpState, InvlerpStateSchema, RangeSchema } from "../net/gen/volcast/v1/scene_pb";
import type { ShaderControl } from "../net/gen/volcast/v1/session_pb";
import { endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import {
  changeControl,
  controlsOf,
  controlValue,
  toDisplay,
  toLinear,
} from "../state/shader_actions";
import { formatNumber } from "./format";
import { Check, ColourLine, NumberField, SelectLine, SliderField } from "./inputs";
import { ShaderMap } from "./shader_map";

interface Props {
  readonly state: AppState;
}

interface ControlProps<Case extends ShaderControl["kind"]["case"]> extends Props {
  readonly name: string;
  readonly control: ShaderControl;
  readonly kind: Extract<ShaderControl["kind"], { case: Case }>["value"];
}

function Slider({ state, name, control, kind }: ControlProps<"slider">) {
  const now = controlValue(state, control);
  const { min, max, step } = kind;
  // From `min` in steps; the last one may be shorter.
  const fitted = (value: number): number => {
    const stepped = step > 0 ? min + Math.round((value - min) / step) * step : value;
    return Math.min(max, Math.max(min, kind.type === "float" ? stepped : Math.round(stepped)));
  };
  return (
    <SliderField
      label={name}
      value={now.case === "number" ? now.value : kind.initial}
      low={min}
      high={max}
      take={(value, gesture) =>
        changeControl(state, name, { case: "number", value: fitted(value) }, gesture)
      }
      done={() => endGesture(state)}
    />
  );
}

function Select({ state, name, control, kind }: ControlProps<"select">) {
  const now = controlValue(state, control);
  const chosen = kind.options.findIndex((o) => o.value.value === now.value);
  const take = (index: number): void => {
    const value = kind.options[index]?.value;
    if (value?.case === "text") changeControl(state, name, { case: "choice", value: value.value });
    if (value?.case === "number") changeControl(state, name, value);
  };
  return (
    <SelectLine
      label={name}
      value={chosen}
      options={kind.options.map((o, i) => [i, o.label] as const)}
      take={take}
    />
  );
}

/** Two values, from 0 to 1, in a window; from a high one to a low one it is turned round. */
function Invlerp({ state, name, control, kind }: ControlProps<"invlerp">) {
  const now = controlValue(state, control);
  const set = now.case === "invlerp" ? now.value : create(InvlerpStateSchema);
  const unit = { min: 0, max: 1 };
  const range = set.range ?? kind.range ?? create(RangeSchema, unit);
  const window = set.window ?? kind.window ?? create(RangeSchema, unit);
  const change = (part: Partial<InvlerpState>, gesture?: string): void => {
    const value = create(InvlerpStateSchema, { ...set, ...part });
    changeControl(state, name, { case: "invlerp", value }, gesture);
  };
  const take = (part: { min?: number; max?: number }, gesture?: string): void => {
    const next = create(RangeSchema, { ...range, ...part });
    if (next.min !== next.max) change({ range: next }, gesture);
  };
  const show = (part: { min?: number; max?: number }): void => {
    const next = create(RangeSchema, { ...window, ...part });
    if (next.min < next.max) change({ window: next });
  };
  const ends = [
    ["0 at", range.min, (min: number, gesture?: string) => take({ min }, gesture)],
    ["1 at", range.max, (max: number, gesture?: string) => take({ max }, gesture)],
  ] as const;
  return (
    <fieldset class="shader-range">
      <legend>{name}</legend>
      {ends.map(([label, value, set]) => (
        <SliderField
          key={label}
          label={label}
          spoken={`${name}, ${label}`}
          value={value}
          low={window.min}
          high={window.max}
          take={(next, gesture) => set(next, gesture && `${name} ${label}`)}
          done={() => endGesture(state)}
        />
      ))}
      <div class="fields">
        <NumberField
          label="Window from"
          text={formatNumber(window.min)}
          take={(min) => show({ min })}
        />
        <NumberField
          label="Window to"
          text={formatNumber(window.max)}
          take={(max) => show({ max })}
        />
      </div>
      <p class="hint">
        {kind.clamp ? "Values beyond both ends count as the ends." : "Goes on beyond both ends."}
      </p>
    </fieldset>
  );
}

function Control({ state, control }: Props & { readonly control: ShaderControl }) {
  const { name, kind } = control;
  const now = controlValue(state, control);
  switch (kind.case) {
    case "slider":
      return <Slider state={state} name={name} control={control} kind={kind.value} />;
    case "select":
      return <Select state={state} name={name} control={control} kind={kind.value} />;
    case "invlerp":
      return <Invlerp state={state} name={name} control={control} kind={kind.value} />;
    case "color":
      return (
        <ColourLine
          label={name}
          colour={toLinear(now.case === "colour" ? now.value : kind.value)}
          take={(colour, gesture) => {
            const value = { ...colour, ...toDisplay(colour) };
            changeControl(state, name, { case: "colour", value }, gesture);
          }}
          done={() => endGesture(state)}
        />
      );
    case "checkbox":
      return (
        <Check
          checked={now.case === "checked" ? now.value : kind.value}
          take={(value) => changeControl(state, name, { case: "checked", value })}
        >
          {name}
        </Check>
      );
    case "transferFunction":
      return <ShaderMap state={state} control={control} kind={kind.value} />;
    default:
      return null;
  }
}

/** What the code that is drawn lets people set. */
export function ShaderControls({ state }: Props) {
  const controls = controlsOf(state);
  return (
    <div class="options">
      {controls.map((control) => (
        <Control key={control.name} state={state} control={control} />
      ))}
    </div>
  );
}
