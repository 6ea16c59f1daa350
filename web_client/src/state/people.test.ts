import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { PersonSchema, Role, WelcomeSchema } from "../net/gen/volcast/v1/session_pb";
import { createAppState } from "./app_state";
import { eachOnce, mayTake, newAsk, noteOf, steers, whyNotSteering } from "./people";

const ann = create(PersonSchema, { id: 1, name: "Ann", role: Role.CONTROL, steers: true });
const ben = create(PersonSchema, { id: 2, name: "Ben", role: Role.CONTROL });
const cy = create(PersonSchema, { id: 3, name: "Cy", role: Role.WATCH });

function seenBy(me: number, people = [ann, ben, cy]) {
  const state = createAppState();
  state.welcome.value = create(WelcomeSchema, { person: me });
  state.people.value = people;
  state.seat.value = { id: "v", role: Role.CONTROL, link: undefined };
  return state;
}

describe("people", () => {
  it("lets one change what is one's own before anybody else is known", () => {
    const state = createAppState();
    expect(steers(state)).toBe(true);
    state.seat.value = { id: "v", role: Role.CONTROL, link: "signed" };
    expect(steers(state)).toBe(false);
  });

  it("lets the one who steers change things, and tells the others why not", () => {
    expect(whyNotSteering(seenBy(1))).toBeUndefined();
    expect(whyNotSteering(seenBy(2))).toBe("Ann steers this view. Take control to change it.");
    expect(whyNotSteering(seenBy(3))).toBe("Ann steers this view. Ask for control to change it.");
    expect(whyNotSteering(seenBy(3, [ben, cy]))).toMatch(/^Nobody steers this view now\./);
  });

  it("takes who has the view open twice for one person, who steers in one place at a time", () => {
    const beside = create(PersonSchema, { ...ann, steers: false, away: true });
    expect(eachOnce([beside, ben, ann]).map((p) => [p.name, p.steers, p.away])).toEqual([
      ["Ann", true, false],
      ["Ben", false, false],
    ]);
    expect(eachOnce([ann, { ...ann, id: 4 }])).toHaveLength(2);
    const here = seenBy(1, [{ ...beside, away: false }, ann, ben]);
    expect(steers(here)).toBe(false);
    expect(whyNotSteering(here)).toBe(
      "You steer this view beside this one. Take control to change it.",
    );
  });

  it("gives control to those who may have it", () => {
    expect([1, 2, 3].map((me) => mayTake(seenBy(me)))).toEqual([false, true, false]);
  });

  it("says what everybody does", () => {
    const away = create(PersonSchema, { ...cy, away: true, asks: true });
    expect([ann, ben, away].map((p) => noteOf(seenBy(2), p))).toEqual([
      "steers",
      "you, may steer",
      "watches, asks for control, away",
    ]);
  });

  it("reports an ask once", () => {
    const asking = create(PersonSchema, { ...cy, asks: true });
    expect(newAsk([ann, cy], [ann, asking])).toMatch(/^Cy asks/);
    expect(newAsk([ann, asking], [ann, asking])).toBeUndefined();
    expect(newAsk([ann, asking], [ann, cy])).toBeUndefined();
  });
});
