import { type Person, Role } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "./app_state";

type Facts = Pick<AppState, "people" | "seat" | "welcome">;

const isMe = (state: Facts, person: Person): boolean => person.id === state.welcome.value?.person;

/** Oneself, as the others see one. */
export function myself(state: Facts): Person | undefined {
  return state.people.value.find((p) => isMe(state, p));
}

/** True where settings and camera are one's own to change: alone, or as the one who steers. */
export function steers(state: Facts): boolean {
  const { people, seat } = state;
  if (people.value.length === 0) return seat.value?.link === undefined;
  return myself(state)?.steers ?? seat.value === undefined;
}

/** True where steering can be had without anybody's doing. */
export const mayTake = (state: Facts): boolean =>
  !steers(state) && myself(state)?.role === Role.CONTROL;

/** True where others are in the view, or could come by a link. */
export const isShared = (state: Pick<AppState, "serverSteps">): boolean =>
  state.serverSteps.value !== undefined;

/** Why nothing can be changed here, as a sentence; undefined for the one who steers. */
export function whyNotSteering(state: Facts): string | undefined {
  if (steers(state)) return undefined;
  const name = state.people.value.find((p) => p.steers)?.name;
  const who = name === undefined ? "Nobody steers this view now." : `${name} steers this view.`;
  return `${who} ${mayTake(state) ? "Take control to change it." : "Ask for control to change it."}`;
}

/** What stands beside a name in the list. */
export function noteOf(state: Facts, person: Person): string {
  const parts = [
    isMe(state, person) ? "you" : "",
    person.steers ? "steers" : person.role === Role.CONTROL ? "may steer" : "watches",
    person.asks ? "asks for control" : "",
    person.away ? "away" : "",
  ];
  return parts.filter((part) => part !== "").join(", ");
}

/** A sentence for who steers, where somebody began to ask between two lists. */
export function newAsk(before: readonly Person[], now: readonly Person[]): string | undefined {
  const asked = (id: number): boolean => before.some((p) => p.id === id && p.asks);
  const name = now.find((p) => p.asks && !asked(p.id))?.name;
  return name === undefined ? undefined : `${name} asks for control: hand it over under People.`;
}
