import { type Person, Role } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "./app_state";

type Facts = Pick<AppState, "people" | "seat" | "welcome">;

const isMe = (state: Facts, person: Person): boolean => person.id === state.welcome.value?.person;

/**
 * Everybody once: who has the view open more than once is one person. They steer and ask if they do in any of their
 * places, and are away if they are in all.
 */
export function eachOnce(people: readonly Person[]): Person[] {
  const found = new Map<number, Person>();
  for (const person of people) {
    const known = found.get(person.id) ?? person;
    found.set(person.id, {
      ...known,
      role: Math.max(known.role, person.role),
      steers: known.steers || person.steers,
      asks: known.asks || person.asks,
      away: known.away && person.away,
    });
  }
  return [...found.values()];
}

/** One's own place in this view: the server lists it before others of oneself. */
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

function whoSteers(state: Facts): string {
  const person = state.people.value.find((p) => p.steers);
  if (!person) return "Nobody steers this view now.";
  if (isMe(state, person)) return "You steer this view beside this one.";
  return `${person.name} steers this view.`;
}

/** Why nothing can be changed here, as a sentence; undefined for the one who steers. */
export function whyNotSteering(state: Facts): string | undefined {
  if (steers(state)) return undefined;
  const who = whoSteers(state);
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
