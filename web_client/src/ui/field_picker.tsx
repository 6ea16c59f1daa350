import { create } from "@bufbuild/protobuf";
import { RangeSchema, Scale_Kind, ScaleSchema } from "../net/gen/volcast/v1/scene_pb";
import { axisOfSlot, endGesture, fieldOf, isMesh } from "../state/actions";
import type { AppState } from "../state/app_state";
import {
  changeField,
  changeInterval,
  changeMarkers,
  changeScale,
  chooseScale,
  markerFields,
} from "../state/layer_actions";
import { kScaleLabels, type Slot } from "../state/models";
import { isRefused } from "../state/refusal";
import { formatNumber, formatValue } from "./format";
import { Check, ListField, NumberField, SelectLine, SliderField } from "./inputs";

interface Props {
  readonly state: AppState;
}

const kScales = [Scale_Kind.LINEAR, Scale_Kind.LOG, Scale_Kind.POWER].map(
  (kind) => [kind, kScaleLabels[kind]] as const,
);

/** How a field's values are laid out before anything else looks at them. */
export function ScaleOptions({ state, slot }: Props & { readonly slot: Slot }) {
  const field = fieldOf(state, slot);
  const layer = state.layer.value;
  if (!field || !layer) return null;
  const path = slot === "first" ? "scale" : "density_scale";
  const scale = (slot === "first" ? layer.scale : layer.densityScale) ?? create(ScaleSchema);
  const domain = scale.domain ?? create(RangeSchema, { min: field.min, max: field.max });
  const span = domain.max - domain.min;
  const setDomain = (part: { min?: number; max?: number }): void =>
    changeScale(state, slot, {
      ...scale,
      domain: create(RangeSchema, { min: domain.min, max: domain.max, ...part }),
    });
  const limits = (
    <>
      <NumberField
        label="Domain from"
        text={formatValue(domain.min, span, 6)}
        invalid={isRefused(state, `${path}.domain`)}
        take={(min) => setDomain({ min })}
      />
      <NumberField
        label="to"
        text={formatValue(domain.max, span, 6)}
        invalid={isRefused(state, `${path}.domain`)}
        take={(max) => setDomain({ max })}
      />
    </>
  );
  return (
    <>
      <SelectLine
        label="Scale"
        value={scale.kind}
        options={kScales}
        invalid={isRefused(state, path)}
        take={(kind) => chooseScale(state, slot, kind)}
      />
      {scale.kind !== Scale_Kind.LINEAR && (
        <div class="fields">
          {limits}
          {scale.kind === Scale_Kind.POWER && (
            <NumberField
              label="Exponent"
              text={formatNumber(scale.exponent || 1)}
              invalid={isRefused(state, `${path}.exponent`)}
              take={(exponent) => changeScale(state, slot, { ...scale, exponent })}
            />
          )}
        </div>
      )}
    </>
  );
}

/** Only the part of the data whose values lie between two ends. */
function IntervalOptions({ state }: Props) {
  const field = state.field.value;
  const interval = state.layer.value?.interval;
  if (!field) return null;
  const axis = axisOfSlot(state);
  const low = Math.max(field.min, axis.low);
  const high = Math.min(field.max, axis.high);
  const invalid = isRefused(state, "interval");
  const shared = { low, high, axis, invalid, done: () => endGesture(state) };
  return (
    <>
      <Check
        checked={interval !== undefined}
        take={(on) => changeInterval(state, on ? { min: low, max: high } : undefined)}
      >
        Only a range of values
      </Check>
      {interval && (
        <>
          <SliderField
            {...shared}
            label="From"
            value={interval.min}
            take={(min, gesture) => changeInterval(state, { min, max: interval.max }, gesture)}
          />
          <SliderField
            {...shared}
            label="To"
            value={interval.max}
            take={(max, gesture) => changeInterval(state, { min: interval.min, max }, gesture)}
          />
        </>
      )}
    </>
  );
}

/** Only cells with certain values in a field of cells. */
function MarkerOptions({ state }: Props) {
  const fields = markerFields(state);
  const markers = state.layer.value?.markers;
  if (fields.length === 0) return null;
  const chosen = fields.find((f) => f.name === markers?.field);
  const smallest = (name: string): number[] => {
    const field = fields.find((f) => f.name === name);
    return field ? [field.min] : [];
  };
  return (
    <>
      <SelectLine
        label="Cells"
        value={markers?.field ?? ""}
        options={[["", "All"], ...fields.map((f) => [f.name, `By ${f.name}`] as const)]}
        invalid={isRefused(state, "markers.field")}
        take={(name) => changeMarkers(state, name, smallest(name))}
      />
      {markers && chosen && (
        <ListField
          label={`Values, ${formatNumber(chosen.min)} to ${formatNumber(chosen.max)}`}
          values={markers.values}
          invalid={isRefused(state, "markers")}
          take={(values) => changeMarkers(state, markers.field, values)}
        />
      )}
    </>
  );
}

/** Which of the dataset's fields is shown, how it is scaled and what part of it. */
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
      <div class="options">
        {isMesh(state) && <ScaleOptions state={state} slot="first" />}
        <IntervalOptions state={state} />
        {isMesh(state) && <MarkerOptions state={state} />}
      </div>
    </section>
  );
}
