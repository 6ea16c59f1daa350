import { endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { isRefused } from "../state/refusal";
import { kSpeeds, showStep, stepsOf, togglePlaying } from "../state/time_steps";
import { IconButton } from "./icons";
import { Check, SelectLine } from "./inputs";

/** Which time step of the field is shown, and how they follow each other. */
export function TimePanel({ state }: { readonly state: AppState }) {
  const layer = state.layer.value;
  const count = stepsOf(state);
  if (!layer || count < 2) return null;
  const { on, speed, loop } = state.playing.value;
  const text = `${layer.timeStep + 1} of ${count}`;
  return (
    <section class="section" aria-labelledby="time-heading">
      <div class="section-head">
        <h2 id="time-heading">Time</h2>
        <output class="time-step">{text}</output>
      </div>
      <div class="time-line">
        <IconButton
          icon={on ? "pause" : "play"}
          label={on ? "Pause" : "Play the time steps"}
          onClick={() => togglePlaying(state)}
        />
        <input
          type="range"
          aria-label="Time step"
          aria-valuetext={text}
          aria-invalid={isRefused(state, "time_step") ? "true" : undefined}
          min={0}
          max={count - 1}
          step={1}
          value={layer.timeStep}
          onInput={(e) => showStep(state, Number(e.currentTarget.value))}
          onChange={() => endGesture(state)}
        />
      </div>
      <div class="options">
        <SelectLine
          label="Steps a second, at most"
          value={speed}
          options={kSpeeds.map((s) => [s, String(s)] as const)}
          take={(next) => {
            state.playing.value = { ...state.playing.value, speed: next };
          }}
        />
        <Check
          checked={loop}
          take={(next) => {
            state.playing.value = { ...state.playing.value, loop: next };
          }}
        >
          Begin again at the end
        </Check>
      </div>
    </section>
  );
}
