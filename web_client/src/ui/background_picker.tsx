import { changeScene, endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { ColourLine } from "./inputs";

const kBlack = { r: 0, g: 0, b: 0 };

/** What lies behind the data. */
export function BackgroundPicker({ state }: { readonly state: AppState }) {
  const scene = state.scene.value;
  if (!scene) return null;
  return (
    <section class="section" aria-label="Background">
      <ColourLine
        label="Background"
        colour={scene.background ?? kBlack}
        take={(background, gesture) => changeScene(state, { background }, gesture)}
        done={() => endGesture(state)}
      />
    </section>
  );
}
