import type { AppState } from "../state/app_state";

/** How far a recording is, and its end. */
export function RecordingChip({ state }: { readonly state: AppState }) {
  const recording = state.recording.value;
  if (!recording) return null;
  return (
    <div class="recording">
      <span role="status">Recording a turn</span>
      <progress aria-label="Recorded" max={1} value={recording.progress} />
      <button type="button" class="text-button" onClick={recording.stop}>
        Stop
      </button>
    </div>
  );
}
