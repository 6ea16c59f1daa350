import type { AppState, Edit, Refusal } from "./app_state";
import { startHistory } from "./history";

/** What the panel calls the parts of a scene; a path that is not here is said as it is. */
const kNames: readonly (readonly [RegExp, string])[] = [
  [/density_function/, "Map of the second field"],
  [/transfer_function/, "Colour and opacity"],
  [/density_scale\.domain/, "Domain of the second field's scale"],
  [/density_scale/, "Scale of the second field"],
  [/scale\.domain/, "Domain of the scale"],
  [/scale\.exponent/, "Exponent of the scale"],
  [/extinction_scale/, "Strength"],
  [/(^|\.)scale/, "Scale"],
  [/levels\.count/, "Number of levels"],
  [/levels\.first/, "First level"],
  [/levels\.last/, "Last level"],
  [/levels/, "Levels"],
  [/density_field/, "Second field"],
  [/interval/, "Range of values"],
  [/markers/, "Cells"],
  [/edge_width/, "Edge width"],
  [/exposure/, "Exposure"],
  [/shader/, "Shader"],
  [/(^|\.)light/, "Light"],
  [/cross_sections/, "Cross-sections"],
  [/channels/, "Channels"],
  [/gain/, "Gain"],
  [/step_world/, "Step"],
  [/depth_samples/, "Samples over the depth"],
  [/integrator/, "Integrator"],
  [/evaluator/, "Evaluator"],
  [/accuracy/, "Accuracy"],
  [/clip_planes/, "Clipping"],
  [/background/, "Background"],
  [/camera/, "Camera"],
  [/dataset/, "Data"],
  [/field/, "Field"],
  [/model/, "Ray model"],
];

/** `layers[0].levels.count: `, which the server says for scripts, once or twice. */
const kLeadingPaths = /^([a-z_]+(\[\d+\])?(\.[a-z_]+(\[\d+\])?)*:\s)+/;

/** "-0.500000" and "3.000000" as people write them. */
const plainNumbers = (text: string): string =>
  text.replace(/(\d+)\.(\d*?)0+(?!\d)/g, (_, whole: string, rest: string) =>
    rest ? `${whole}.${rest}` : whole,
  );

/** The server's reason as a sentence that names the setting as the panel does. */
export function sentenceOf({ field, message }: Pick<Refusal, "field" | "message">): string {
  const said = field ? message.replace(kLeadingPaths, "") : message;
  const name = kNames.find(([path]) => path.test(field))?.[1] ?? field;
  const text = plainNumbers(said.trim() || "the server refused this");
  const end = /[.!?]$/.test(text) ? "" : ".";
  return name ? `${name}: ${text}${end}` : `${text}${end}`;
}

/** True where the newest refusal is about the setting at `path`, a part of its field's path. */
export function isRefused(state: Pick<AppState, "refusal">, path: string): boolean {
  const field = state.refusal.value?.field ?? "";
  const parts = field.replace(/\[\d+\]/g, "").split(".");
  const asked = path.split(".");
  return parts.some((_, i) => asked.every((name, k) => parts[i + k] === name));
}

/** Puts the settings back to those of the picture; the refused ones can be redone, and refused code
 * stays in the editor. */
export function takeBack(state: AppState, accepted: Edit): void {
  const { past, present } = state.edit.value;
  const at = past.lastIndexOf(accepted);
  const kept = at >= 0 ? past.slice(0, at) : past;
  const code = present.scene?.layers[0]?.shader?.code;
  if (code && code !== accepted.scene?.layers[0]?.shader?.code) state.codeDraft.value ??= code;
  state.edit.value = { ...startHistory(accepted), past: kept, future: [present] };
  state.refusal.value = undefined;
}
