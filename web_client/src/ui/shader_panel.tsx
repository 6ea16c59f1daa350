import { useSignal } from "@preact/signals";
import { useId, useRef } from "preact/hooks";
import type { AppState } from "../state/app_state";
import { kRunsCode } from "../state/models";
import { isRefused } from "../state/refusal";
import { applyCode, complaintsOf, removeCode, shownCode } from "../state/shader_actions";
import { isVolume } from "../state/voxel_actions";
import { lazy } from "./lazy";
import { ShaderControls } from "./shader_controls";
import { StepOptions } from "./voxel_panel";

interface Props {
  readonly state: AppState;
}

const ShaderExamplePicker = lazy(
  async () => (await import("./shader_example_picker")).ShaderExamplePicker,
);

const kFirstLines = `void main() {
  emitGrayscale(toNormalized(getDataValue()));
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

/** Shows a line of the code, from 1. */
function selectLine(area: HTMLTextAreaElement | null, line: number): void {
  if (!area) return;
  const lines = area.value.split("\n");
  const start = lines.slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
  area.focus();
  area.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
}

interface ComplaintsProps extends Props {
  readonly id: string;
  readonly show: (line: number) => void;
}

/** What is wrong with the code, by line; it is not drawn then. */
function Complaints({ state, id, show }: ComplaintsProps) {
  const complaints = complaintsOf(state);
  return (
    <div id={id} aria-live="polite">
      {complaints.length > 0 && (
        <p class="hint">This code is not drawn; the picture stays as it was.</p>
      )}
      <ul class="complaints">
        {complaints.map(({ line, column, message }, i) => (
          <li key={i}>
            <button type="button" title="Show the line" onClick={() => show(line)}>
              Line {line}
              {column > 1 && `, column ${column}`}
            </button>
            : {message}
          </li>
        ))}
      </ul>
    </div>
  );
}

/** Code that says what a sample shows, and the controls that it declares. */
export function ShaderPanel({ state }: Props) {
  const id = useId();
  const open = useSignal(false);
  const area = useRef<HTMLTextAreaElement>(null);
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
      <details
        class="advanced"
        onToggle={(e) => {
          open.value = e.currentTarget.open;
        }}
      >
        <summary>Code</summary>
        <div class="options">
          {open.value && <ShaderExamplePicker state={state} />}
          <textarea
            ref={area}
            class="code"
            aria-label="Shader code"
            aria-describedby={id}
            aria-invalid={isWrong ? "true" : undefined}
            rows={10}
            wrap="off"
            spellcheck={false}
            autocomplete="off"
            autocapitalize="off"
            placeholder={kFirstLines}
            value={shownCode(state)}
            onInput={(e) => {
              state.codeDraft.value = e.currentTarget.value;
            }}
            onKeyDown={(e) => onKey(e, state)}
          />
          <Complaints state={state} id={id} show={(line) => selectLine(area.current, line)} />
          <div class="line">
            <span class="hint">Ctrl+Enter applies</span>
            {isDrawn && (
              <button type="button" class="text-button" onClick={() => removeCode(state)}>
                Use the map
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
