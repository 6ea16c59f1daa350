import type { AppState } from "../state/app_state";
import { mayTake, myself, whyNotSteering } from "../state/people";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

/** Takes control where one may, else asks for it. */
export function ControlButton({ state, port }: Props) {
  if (mayTake(state)) {
    return (
      <button type="button" class="text-button" onClick={port.takeControl}>
        Take control
      </button>
    );
  }
  const asks = myself(state)?.asks ?? false;
  return (
    <button type="button" class="text-button" onClick={() => port.askControl(asks)}>
      {asks ? "Ask no more" : "Ask for control"}
    </button>
  );
}

/** Why the settings below cannot be changed, and what helps. */
export function SteerNote({ state, port }: Props) {
  const why = whyNotSteering(state);
  return (
    <div class="steer-host" role="status">
      {why !== undefined && (
        <div class="steer-note">
          <p>{myself(state)?.asks ? `${why.replace(/\.[^.]*\.$/, ".")} You have asked.` : why}</p>
          <ControlButton state={state} port={port} />
        </div>
      )}
    </div>
  );
}
