import { ViewState } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "./app_state";
import { whyNotSteering } from "./people";
import { sentenceOf } from "./refusal";

export type BadgeKind =
  | "connecting"
  | "waiting"
  | "moving"
  | "live"
  | "refining"
  | "final"
  | "watching"
  | "recovering"
  | "reconnecting"
  | "refused"
  | "failed";

/** What the user should know about the picture right now. */
export interface Badge {
  readonly kind: BadgeKind;
  readonly label: string;
  readonly detail: string;
}

type Facts = Pick<
  AppState,
  "connection" | "view" | "picture" | "newestInput" | "refusal" | "people" | "seat" | "welcome"
>;

/** `exact`: the hash of the pixels here is that of the pixels in the server. */
function lossless(exact: boolean | undefined): Badge {
  if (exact === false) {
    const detail = "The pixels here are not those that were rendered: their hashes differ";
    return { kind: "failed", label: "Not exact", detail };
  }
  if (exact) {
    const detail = "Exactly what was rendered: the hash of all pixels was compared";
    return { kind: "final", label: "Final, exact", detail };
  }
  return { kind: "final", label: "Final, lossless", detail: "Lossless: what was rendered" };
}

/** Reads signals, so that whoever shows it follows them; `now` on performance.now()'s clock. */
export function badgeOf(state: Facts, now: number): Badge {
  const connection = state.connection.value;
  if (connection.kind === "lost") {
    const seconds = Math.max(0, Math.ceil((connection.retryAt - now) / 1000));
    const label = `Reconnecting in ${seconds} s`;
    return { kind: "reconnecting", label, detail: `Connection lost: ${connection.reason}` };
  }
  if (connection.kind === "connecting") {
    return { kind: "connecting", label: "Connecting", detail: "Waiting for the server" };
  }
  const view = state.view.value;
  if (view?.state === ViewState.RECOVERING) {
    const detail = view.message || "The renderer is being replaced; nothing is lost";
    return { kind: "recovering", label: "Recovering", detail };
  }
  if (view?.state === ViewState.FAILED) {
    return { kind: "failed", label: "Not drawn", detail: view.message };
  }
  const refusal = state.refusal.value;
  if (refusal) {
    return { kind: "refused", label: "Not as set", detail: sentenceOf(refusal) };
  }
  const picture = state.picture.value;
  if (view?.state === ViewState.WAITING || !picture) {
    return { kind: "waiting", label: "Loading data", detail: view?.message ?? "" };
  }
  const steered = whyNotSteering(state);
  if (steered !== undefined) {
    const exact = picture.lossless && picture.final && picture.exact;
    return { kind: "watching", label: exact ? "Watching, exact" : "Watching", detail: steered };
  }
  if (picture.inputSeq < state.newestInput.value) {
    return { kind: "moving", label: "Moving", detail: "A newer picture is on its way" };
  }
  if (picture.lossless && picture.final) {
    return lossless(picture.exact);
  }
  if (!picture.ready) {
    const detail = "Parts of the volume are coarser than asked for; better pictures follow";
    return { kind: "refining", label: "Loading finer parts", detail };
  }
  return { kind: "live", label: "Live", detail: "Up to date; the lossless picture follows" };
}
