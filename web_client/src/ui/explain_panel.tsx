import { useSignal, useSignalEffect } from "@preact/signals";
import type { AppState } from "../state/app_state";
import { FoldedSection } from "./folded_section";
import { lazy } from "./lazy";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

const PlanList = lazy(async () => (await import("./plan_list")).PlanList);

/** How the picture was drawn and why so; asked again for every picture while it is open. */
export function ExplainPanel({ state, port }: Props) {
  const open = useSignal(false);
  useSignalEffect(() => {
    if (open.value && state.picture.value) port.explain();
  });
  if (!state.layer.value) return null;
  return (
    <FoldedSection heading="How it is drawn" open={open}>
      <PlanList state={state} port={port} />
    </FoldedSection>
  );
}
