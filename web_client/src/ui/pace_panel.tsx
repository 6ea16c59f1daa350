import { useSignal } from "@preact/signals";
import type { AppState } from "../state/app_state";
import { lazy } from "./lazy";

const PaceFacts = lazy(async () => (await import("./pace_facts")).PaceFacts);

/** What is sent over this connection, and what of it may not be given up. */
export function PacePanel({ state }: { readonly state: AppState }) {
  const open = useSignal(false);
  if (!state.layer.value) return null;
  return (
    <section class="section">
      <details
        class="explain pace"
        onToggle={(e) => {
          open.value = e.currentTarget.open;
        }}
      >
        <summary>
          <h2>What is sent</h2>
        </summary>
        {open.value && <PaceFacts state={state} />}
      </details>
    </section>
  );
}
