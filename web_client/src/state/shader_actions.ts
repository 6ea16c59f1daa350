import { create } from "@bufbuild/protobuf";
import {
  type ControlState,
  ControlStateSchema,
  type Layer,
  UserShaderSchema,
} from "../net/gen/volcast/v1/scene_pb";
import type { ShaderComplaint, ShaderControl } from "../net/gen/volcast/v1/session_pb";
import { decodeSrgb, encodeSrgb } from "../transfer/srgb";
import { changeLayer } from "./actions";
import type { AppState } from "./app_state";

/** Code, and whose values its open ranges come from. */
export interface CodeOfData {
  readonly code: string;
  readonly dataset: string;
}

/** What the server reads in code. */
export interface DescribedCode extends CodeOfData {
  readonly controls: readonly ShaderControl[];
  readonly complaints: readonly ShaderComplaint[];
}

const codeOf = (layer: Layer | undefined): string => layer?.shader?.code ?? "";

/** What the editor shows. */
export function shownCode(state: AppState): string {
  return state.codeDraft.value ?? codeOf(state.layer.value);
}

/** The description of this code, where it is known. */
function known(state: AppState, code: string): DescribedCode | undefined {
  const dataset = state.layer.value?.dataset;
  return state.describedCodes.value.find((d) => d.code === code && d.dataset === dataset);
}

/** Code that the server has to describe next; a control's change leaves it as it is. */
export function codeToDescribe(state: AppState): CodeOfData | undefined {
  const dataset = state.layer.value?.dataset;
  const code = state.appliedCode.value ?? codeOf(state.layer.value);
  if (!dataset || code === "" || known(state, code)) return undefined;
  return { code, dataset };
}

/** Complaints about the code that was applied last, or is drawn. */
export function complaintsOf(state: AppState): readonly ShaderComplaint[] {
  return known(state, shownCode(state))?.complaints ?? [];
}

/** Controls of the code that is drawn. */
export function controlsOf(state: AppState): readonly ShaderControl[] {
  return known(state, codeOf(state.layer.value))?.controls ?? [];
}

const kKinds: Readonly<Record<string, string>> = {
  slider: "number",
  color: "colour",
  checkbox: "checked",
  invlerp: "invlerp",
  transferFunction: "map",
};

/** The kind of state that a control takes. */
function stateKind({ kind }: ShaderControl): string | undefined {
  if (kind.case !== "select") return kKinds[kind.case ?? ""];
  return kind.value.type === "string_t" ? "choice" : "number";
}

/** Whether a control, as it is declared now, can still take the state that it had. */
function takes({ name, kind, ...rest }: ShaderControl, state: ControlState): boolean {
  if (name !== state.name || stateKind({ name, kind, ...rest }) !== state.value.case) return false;
  const { value } = state.value;
  if (kind.case === "slider")
    return Number(value) >= kind.value.min && Number(value) <= kind.value.max;
  if (kind.case === "select") return kind.value.options.some((o) => o.value.value === value);
  return true;
}

/** Draws described code, with the states that its controls can still take. */
function draw(state: AppState, { code, controls }: DescribedCode): void {
  const before = state.layer.value?.shader?.controls ?? [];
  const kept = before.filter((s) => controls.some((c) => takes(c, s)));
  const shader = create(UserShaderSchema, { code, controls: kept });
  // Code gives colours as they are seen, reads channels itself, and values as they are stored.
  changeLayer(state, { shader, light: undefined, channels: [], scale: undefined });
  state.codeDraft.value = undefined;
}

/** Draws what the editor shows as soon as the server has read it without complaints. */
export function applyCode(state: AppState): void {
  const code = shownCode(state);
  if (code.trim() === "") {
    removeCode(state);
    state.codeDraft.value = undefined;
    return;
  }
  state.appliedCode.value = code;
  const found = known(state, code);
  if (found) conclude(state, found);
}

const kMostDescribed = 8;

/** The server's answer. */
export function takeDescription(state: AppState, described: DescribedCode): void {
  state.describedCodes.value = [described, ...state.describedCodes.value].slice(0, kMostDescribed);
  if (described.code === state.appliedCode.value) conclude(state, described);
}

/** Draws what was applied, if nothing is wrong with it. */
function conclude(state: AppState, described: DescribedCode): void {
  state.appliedCode.value = undefined;
  if (described.complaints.length === 0) draw(state, described);
}

/** Draws by the map again; the editor keeps the code. */
export function removeCode(state: AppState): void {
  const code = codeOf(state.layer.value);
  state.appliedCode.value = undefined;
  if (code === "") return;
  state.codeDraft.value ??= code;
  changeLayer(state, { shader: undefined });
}

export type ControlValue = ControlState["value"];

/** What a control is set to: as the user did, or as it is declared. */
export function controlValue(state: AppState, { name, kind }: ShaderControl): ControlValue {
  const set = state.layer.value?.shader?.controls.find((s) => s.name === name);
  if (set) return set.value;
  switch (kind.case) {
    case "slider":
      return { case: "number", value: kind.value.initial };
    case "color":
      return { case: "colour", value: kind.value };
    case "checkbox":
      return { case: "checked", value: kind.value };
    case "select": {
      const { value } = kind.value.options[kind.value.initial] ?? {};
      if (value?.case === "text") return { case: "choice", value: value.value };
      return value?.case === "number" ? value : { case: undefined };
    }
    default:
      return { case: undefined };
  }
}

/** Sets one control of the code that is drawn. */
export function changeControl(
  state: AppState,
  name: string,
  value: ControlValue,
  gesture?: string,
): void {
  const shader = state.layer.value?.shader;
  if (!shader) return;
  const others = shader.controls.filter((s) => s.name !== name);
  const controls = [...others, create(ControlStateSchema, { name, value })];
  const next = create(UserShaderSchema, { code: shader.code, controls });
  changeLayer(state, { shader: next }, gesture && `control ${name}`);
}

interface Rgb {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

/** Colours of controls are the display's; the client's own are linear. */
export const toLinear = ({ r, g, b }: Rgb): Rgb => ({
  r: decodeSrgb(r),
  g: decodeSrgb(g),
  b: decodeSrgb(b),
});

export const toDisplay = ({ r, g, b }: Rgb): Rgb => ({
  r: encodeSrgb(r),
  g: encodeSrgb(g),
  b: encodeSrgb(b),
});
