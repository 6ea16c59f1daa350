import { useSignal } from "@preact/signals";
import type { AppState } from "../state/app_state";
import { shownCode } from "../state/shader_actions";
import { kShaderExamples } from "./shader_examples";

const kOwn = -2;

/** Puts an example into the editor; what stood there can be had back. */
export function ShaderExamplePicker({ state }: { readonly state: AppState }) {
  const own = useSignal("");
  const isExample = (code: string): boolean => kShaderExamples.some((e) => e.code === code);
  const choose = (index: number): void => {
    const before = shownCode(state);
    if (before.trim() !== "" && !isExample(before)) own.value = before;
    const code = index === kOwn ? own.value : kShaderExamples[index]?.code;
    if (code !== undefined) state.codeDraft.value = code;
  };
  return (
    <label class="line">
      <span>Start from an example</span>
      <select
        class="beside"
        value=""
        onChange={(e) => {
          choose(Number(e.currentTarget.value));
          e.currentTarget.value = "";
        }}
      >
        <option value="">Choose</option>
        {own.value !== "" && <option value={kOwn}>Back to your own code</option>}
        {kShaderExamples.map(({ name }, i) => (
          <option key={name} value={i}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}
