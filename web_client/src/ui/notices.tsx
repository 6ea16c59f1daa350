import { type AppState, dismiss } from "../state/app_state";
import { IconButton } from "./icons";

/** Sentences over the picture that wait to be read and never block. */
export function Notices({ state }: { readonly state: AppState }) {
  return (
    <div class="notices" role="log" aria-label="Messages" aria-live="polite">
      {state.notices.value.map((notice) => (
        <div key={notice.id} class="notice" data-kind={notice.kind}>
          <p>{notice.text}</p>
          <IconButton icon="close" label="Dismiss" onClick={() => dismiss(state, notice.id)} />
        </div>
      ))}
    </div>
  );
}
