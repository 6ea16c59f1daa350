import { useId } from "preact/hooks";
import type { AppState } from "../state/app_state";
import { kRunsCode } from "../state/models";
import { isRefused } from "../state/refusal";
import { applyCode, complaintsOf, removeCode, shownCode } from "../state/shader_actions";
import { isVolume } from "../state/voxel_actions";
import { ShaderControls } from "./shader_controls";
import { StepOptions } from "./voxel_panel";

interface Props {
  readonly state: AppState;
}

const kExample = `#uicontrol invlerp range
#uicontrol vec3 tint color(default="#ffd080")
#uicontrol float opacity slider(min=0, max=1, default=0.3)

void main() {
  float x = range();
  emitRGBA(vec4(tint * x, opacity * x));
}`;

const kIndent = "  ";

/** Ctrl+Enter applies, Tab indents; Shift+Tab still leaves the editor. */
function onKey(event: KeyboardEvent & { currentTarget: HTMLTextAreaElement }, state: AppState) {
  const area = event.currentTarget;
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
    event.preventDefault();
    applyCode(state);
  } else if (event.key === "Tab" && !event.shiftKey) {
    event.preventDefault();
    area.setRangeText(kIndent, area.selectionStart, area.selectionEnd, "end");
    state.codeDraft.value = area.value;
  }
}

function Complaints({ state, id }: Props & { readonly id: string }) {
  const complaints = complaintsOf(state);
  return (
    <ul id={id} class="complaints" aria-live="polite">
      {complaints.map(({ line, column, message }, i) => (
        <li key={i}>
          Line {line}
          {column > 1 && `, column ${column}`}: {message}
        </li>
      ))}
    </ul>
  );
}

/** Code that says what a sample shows, and the controls that it declares. */
export function ShaderPanel({ state }: Props) {
  const id = useId();
  const layer = state.layer.value;
  if (!layer || !kRunsCode.has(layer.model)) return null;
  const isDrawn = Boolean(layer.shader?.code);
  const isWrong = complaintsOf(state).length > 0 || isRefused(state, "shader");
  return (
    <section class="section" aria-labelledby="shader-heading">
      <h2 id="shader-heading">Shader</h2>
      {isDrawn && <ShaderControls state={state} />}
      {isDrawn && !isVolume(state) && (
        <div class="options">
          <StepOptions state={state} usual="A 64th of the diagonal" />
        </div>
      )}
      <details class="advanced">
        <summary>Code</summary>
        <div class="options">
          <textarea
            class="code"
            aria-label="Shader code"
            aria-describedby={id}
            aria-invalid={isWrong ? "true" : undefined}
            rows={10}
            wrap="off"
            spellcheck={false}
            autocomplete="off"
            autocapitalize="off"
            placeholder={kExample}
            value={shownCode(state)}
            onInput={(e) => {
              state.codeDraft.value = e.currentTarget.value;
            }}
            onKeyDown={(e) => onKey(e, state)}
          />
          <Complaints state={state} id={id} />
          <div class="line">
            <span class="hint">Ctrl+Enter applies</span>
            {isDrawn && (
              <button type="button" class="text-button" onClick={() => removeCode(state)}>
                Use the map
              </button>
            )}
            {shownCode(state) === "" && (
              <button
                type="button"
                class="text-button"
                onClick={() => {
                  state.codeDraft.value = kExample;
                }}
              >
                Example
              </button>
            )}
            <button type="button" class="text-button" onClick={() => applyCode(state)}>
              Apply
            </button>
          </div>
        </div>
      </details>
    </section>
  );
}
