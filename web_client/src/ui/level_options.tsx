import { create } from "@bufbuild/protobuf";
import { type Levels, LevelsSchema } from "../net/gen/volcast/v1/scene_pb";
import { axisOfSlot, changeLayer, endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { kindOf, type LevelsKind, withKind } from "../state/levels";
import { isRefused } from "../state/refusal";
import { formatNumber, formatValue } from "./format";
import { ListField, NumberField, SelectLine, SliderField } from "./inputs";

const kKinds: readonly (readonly [LevelsKind, string])[] = [
  ["one", "One"],
  ["list", "List"],
  ["linear", "Even steps"],
  ["log", "Logarithmic steps"],
  ["power", "Power steps"],
];

interface RunProps {
  readonly state: AppState;
  readonly levels: Levels;
  readonly span: number;
  readonly change: (part: Partial<Levels>) => void;
}

/** Levels from one end to the other. */
function Run({ state, levels, span, change }: RunProps) {
  return (
    <div class="fields">
      <NumberField
        label="First"
        text={formatValue(levels.first, span, 6)}
        invalid={isRefused(state, "levels.first")}
        take={(first) => change({ first })}
      />
      <NumberField
        label="Last"
        text={formatValue(levels.last, span, 6)}
        invalid={isRefused(state, "levels.last")}
        take={(last) => change({ last })}
      />
      <NumberField
        label="Count"
        text={String(levels.count)}
        invalid={isRefused(state, "levels.count")}
        take={(count) => change({ count: Math.round(Math.min(1e6, Math.max(-1e6, count))) })}
      />
      {kindOf(levels) === "power" && (
        <NumberField
          label="Exponent"
          text={formatNumber(levels.exponent || 2)}
          invalid={isRefused(state, "levels.exponent")}
          take={(exponent) => change({ exponent })}
        />
      )}
    </div>
  );
}

/** At which values isosurfaces are shown. */
export function LevelOptions({ state }: { readonly state: AppState }) {
  const field = state.field.value;
  const levels = state.layer.value?.levels ?? create(LevelsSchema);
  if (!field) return null;
  const kind = kindOf(levels);
  const change = (part: Partial<Levels>, gesture?: string): void =>
    changeLayer(state, { levels: create(LevelsSchema, { ...levels, ...part }) }, gesture);
  const axis = axisOfSlot(state);
  const low = Math.max(field.min, axis.low);
  const high = Math.min(field.max, axis.high);
  return (
    <>
      <SelectLine
        label="Levels"
        value={kind}
        options={kKinds}
        take={(next) =>
          changeLayer(state, { levels: withKind(levels, next, { min: low, max: high }) })
        }
      />
      {kind === "one" && (
        <SliderField
          label="Level"
          value={levels.values[0] ?? low}
          low={low}
          high={high}
          axis={axis}
          invalid={isRefused(state, "levels")}
          take={(value, gesture) => change({ values: [value] }, gesture)}
          done={() => endGesture(state)}
        />
      )}
      {kind === "list" && (
        <ListField
          label="Values"
          values={levels.values}
          invalid={isRefused(state, "levels")}
          take={(values) => change({ values: [...values] })}
        />
      )}
      {kind !== "one" && kind !== "list" && (
        <Run state={state} levels={levels} span={high - low} change={change} />
      )}
    </>
  );
}
