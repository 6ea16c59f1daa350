import { useSignal } from "@preact/signals";
import type { AppState } from "../state/app_state";
import { FoldedSection } from "./folded_section";
import { lazy } from "./lazy";

const PaceFacts = lazy(async () => (await import("./pace_facts")).PaceFacts);

/** What is sent over this connection, and what of it may not be given up. */
export function PacePanel({ state }: { readonly state: AppState }) {
  const open = useSignal(false);
  if (!state.layer.value) return null;
  return (
    <FoldedSection heading="What is sent" open={open} look="pace">
      <PaceFacts state={state} />
    </FoldedSection>
  );
}
