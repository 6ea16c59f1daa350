import type { ComponentChildren } from "preact";
import type { Colour as ColourMessage } from "../net/gen/volcast/v1/scene_pb";
import { type Axis, kStraight } from "../transfer/scale";
import { type Colour, fromHex, toHex } from "../transfer/srgb";
import { formatNumber, formatValue, parseNumber, parseNumbers } from "./format";

interface TextProps<T> {
  readonly text: string;
  readonly read: (text: string) => T | undefined;
  readonly take: (value: T) => void;
  readonly disabled?: boolean | undefined;
  readonly invalid?: boolean | undefined;
  /** Said, and not shown. */
  readonly spoken?: string | undefined;
}

/** A text that is taken when the field is left or Enter is pressed; nonsense is put back. */
function TextInput<T>({ text, read, take, disabled, invalid, spoken }: TextProps<T>) {
  return (
    <input
      type="text"
      inputMode="decimal"
      autocomplete="off"
      value={text}
      disabled={disabled}
      aria-invalid={invalid ? "true" : undefined}
      aria-label={spoken}
      onChange={(e) => {
        const value = read(e.currentTarget.value);
        if (value !== undefined) take(value);
        e.currentTarget.value = text;
      }}
    />
  );
}

interface NumberProps {
  readonly label: string;
  readonly text: string;
  readonly take: (value: number) => void;
  readonly disabled?: boolean | undefined;
  readonly invalid?: boolean | undefined;
}

/** A number below its label. */
export function NumberField(props: NumberProps) {
  return (
    <label class="number">
      <span>{props.label}</span>
      <TextInput {...props} read={parseNumber} />
    </label>
  );
}

/** A number beside its label. */
export function NumberLine(props: NumberProps) {
  return (
    <label class="line number">
      <span>{props.label}</span>
      <TextInput {...props} read={parseNumber} />
    </label>
  );
}

interface ListProps {
  readonly label: string;
  readonly values: readonly number[];
  readonly take: (values: readonly number[]) => void;
  readonly invalid?: boolean | undefined;
}

/** Numbers with spaces or commas between them. */
export function ListField({ label, values, take, invalid }: ListProps) {
  const text = values.map((v) => formatNumber(v, 6)).join(", ");
  return (
    <label class="number">
      <span>{label}</span>
      <TextInput text={text} read={parseNumbers} take={take} invalid={invalid} />
    </label>
  );
}

interface SliderProps {
  readonly label: string;
  readonly value: number;
  readonly low: number;
  readonly high: number;
  readonly axis?: Axis | undefined;
  /** Said instead of the label, where that is too short by itself. */
  readonly spoken?: string | undefined;
  readonly invalid?: boolean | undefined;
  readonly take: (value: number, gesture?: string) => void;
  readonly done: () => void;
}

/** A number with a slider; the number may lie outside what the slider reaches. */
export function SliderField({
  label,
  value,
  low,
  high,
  axis = kStraight,
  spoken = label,
  invalid,
  take,
  done,
}: SliderProps) {
  const from = axis.along(low);
  const span = axis.along(high) - from;
  const text = formatValue(value, high - low, 6);
  return (
    <div class="slider-field">
      <span aria-hidden="true">{label}</span>
      <input
        type="range"
        aria-label={spoken}
        aria-valuetext={text}
        min={0}
        max={1}
        step={0.001}
        value={span > 0 ? (axis.along(value) - from) / span : 0}
        onInput={(e) => take(axis.back(from + span * Number(e.currentTarget.value)), label)}
        onChange={done}
      />
      <span class="number">
        <TextInput
          spoken={`${spoken}, as a number`}
          text={text}
          read={parseNumber}
          take={(v) => take(v)}
          invalid={invalid}
        />
      </span>
    </div>
  );
}

interface SelectProps<T extends string | number> {
  readonly label: string;
  readonly value: T;
  readonly options: readonly (readonly [value: T, name: string])[];
  readonly take: (value: T) => void;
  readonly invalid?: boolean | undefined;
}

/** One of a few, beside its label. */
export function SelectLine<T extends string | number>(props: SelectProps<T>) {
  const { label, value, options, take, invalid } = props;
  return (
    <label class="line">
      <span>{label}</span>
      <select
        class="beside"
        value={String(value)}
        aria-invalid={invalid ? "true" : undefined}
        onChange={(e) => {
          const chosen = options.find(([v]) => String(v) === e.currentTarget.value);
          if (chosen) take(chosen[0]);
        }}
      >
        {options.map(([v, name]) => (
          <option key={v} value={String(v)}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}

interface CheckProps {
  readonly checked: boolean;
  readonly take: (checked: boolean) => void;
  readonly disabled?: boolean | undefined;
  readonly children: ComponentChildren;
}

export function Check({ checked, take, disabled, children }: CheckProps) {
  return (
    <label class="check">
      <input
        type="checkbox"
        checked={checked}
        disabled={disabled}
        onChange={(e) => take(e.currentTarget.checked)}
      />
      {children}
    </label>
  );
}

interface ColourProps {
  readonly label: string;
  readonly colour: Colour;
  readonly take: (colour: ColourMessage, gesture: string) => void;
  readonly done: () => void;
}

/** A colour beside its label; all that is tried while the picker is open is one step. */
export function ColourLine({ label, colour, take, done }: ColourProps) {
  return (
    <label class="line">
      <span>{label}</span>
      <input
        type="color"
        value={toHex(colour)}
        onInput={(e) => {
          const picked = fromHex(e.currentTarget.value);
          if (picked) take({ $typeName: "volcast.v1.Colour", ...picked }, label);
        }}
        onChange={done}
      />
    </label>
  );
}
