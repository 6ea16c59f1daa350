import type { AppState } from "../state/app_state";
import { sentenceOf, takeBack } from "../state/refusal";
import { Icon } from "./icons";

/** Why the newest settings are not drawn, above them; the picture is still the one before. */
export function RefusalNote({ state }: { readonly state: AppState }) {
  const refusal = state.refusal.value;
  const accepted = state.accepted.value;
  return (
    <div class="refusal-host" role="alert">
      {refusal && (
        <div class="refusal">
          <Icon name="warning" />
          <p>{sentenceOf(refusal)} The picture stays as it was.</p>
          {accepted && (
            <button type="button" class="text-button" onClick={() => takeBack(state, accepted)}>
              Take back
            </button>
          )}
        </div>
      )}
    </div>
  );
}
