import { useSignal, useSignalEffect } from "@preact/signals";
import type { AppState } from "../state/app_state";
import { badgeOf } from "../state/badge";
import type { AppPort } from "./port";

/** The state of the connection and of the picture; counts the seconds to the next attempt. */
export function BadgeView({ state, port }: { readonly state: AppState; readonly port: AppPort }) {
  const now = useSignal(performance.now());
  useSignalEffect(() => {
    if (state.connection.value.kind !== "lost") return undefined;
    now.value = performance.now();
    const timer = setInterval(() => {
      now.value = performance.now();
    }, 250);
    return () => clearInterval(timer);
  });
  const badge = badgeOf(state, now.value);
  const spoken = badge.kind === "reconnecting" ? "Connection lost, reconnecting" : badge.label;
  return (
    <div class="badge-row">
      <span class="badge" data-state={badge.kind} title={badge.detail}>
        <span class="badge-dot" aria-hidden="true" />
        <span aria-hidden="true">{badge.label}</span>
        <span class="spoken" role="status">
          {spoken}
        </span>
      </span>
      {badge.kind === "reconnecting" && (
        <button type="button" class="text-button" onClick={port.reconnect}>
          Now
        </button>
      )}
      {badge.kind === "failed" && (
        <button type="button" class="text-button" onClick={port.drawAgain}>
          Try again
        </button>
      )}
    </div>
  );
}
