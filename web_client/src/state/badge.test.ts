import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { PersonSchema, Role, ViewState } from "../net/gen/volcast/v1/session_pb";
import { createAppState, dismiss, notify, type PictureInfo } from "./app_state";
import { badgeOf } from "./badge";

const picture = { inputSeq: 5n, lossless: true, final: true, ready: true } as PictureInfo;

function connected() {
  const state = createAppState();
  state.connection.value = { kind: "open" };
  state.view.value = { state: ViewState.ACTIVE, message: "" };
  state.picture.value = picture;
  state.newestInput.value = 5n;
  return state;
}

describe("badge", () => {
  it("says exact only for the lossless picture of the newest input", () => {
    const state = connected();
    expect(badgeOf(state, 0).kind).toBe("final");
    state.newestInput.value = 6n;
    expect(badgeOf(state, 0).kind).toBe("moving");
    state.newestInput.value = 5n;
    state.picture.value = { ...picture, lossless: false };
    expect(badgeOf(state, 0).kind).toBe("live");
    state.picture.value = { ...picture, final: false };
    expect(badgeOf(state, 0).kind).toBe("live");
    state.picture.value = { ...picture, lossless: false, final: false, ready: false };
    expect(badgeOf(state, 0)).toMatchObject({ kind: "refining", label: "Loading finer parts" });
  });

  it("calls a picture exact only when the hash of its pixels was found equal", () => {
    const state = connected();
    expect(badgeOf(state, 0)).toMatchObject({ kind: "final", label: "Final, lossless" });
    state.picture.value = { ...picture, exact: true };
    expect(badgeOf(state, 0)).toMatchObject({ kind: "final", label: "Final, exact" });
    state.picture.value = { ...picture, exact: false };
    expect(badgeOf(state, 0)).toMatchObject({ kind: "failed", label: "Not exact" });
  });

  it("says that the settings are not those of the picture, whatever the picture is", () => {
    const state = connected();
    const field = "layers[0].exposure";
    state.refusal.value = { inputSeq: 5n, field, message: `${field}: 99 is too much` };
    expect(badgeOf(state, 0)).toMatchObject({
      kind: "refused",
      detail: "Exposure: 99 is too much.",
    });
    state.view.value = { state: ViewState.FAILED, message: "out of memory" };
    expect(badgeOf(state, 0).kind).toBe("failed");
  });

  it("puts trouble before everything else", () => {
    const state = connected();
    state.view.value = { state: ViewState.FAILED, message: "out of memory" };
    expect(badgeOf(state, 0)).toMatchObject({ kind: "failed", detail: "out of memory" });
    state.view.value = { state: ViewState.RECOVERING, message: "" };
    expect(badgeOf(state, 0).kind).toBe("recovering");
    state.connection.value = { kind: "lost", retryAt: 5000, reason: "closed" };
    expect(badgeOf(state, 2900)).toMatchObject({ label: "Reconnecting in 3 s" });
    expect(badgeOf(state, 9000)).toMatchObject({ label: "Reconnecting in 0 s" });
  });

  it("says that somebody else steers, and whether the picture is exact all the same", () => {
    const state = connected();
    state.seat.value = { id: "v", role: Role.WATCH, link: "signed" };
    expect(badgeOf(state, 0)).toMatchObject({ kind: "watching", label: "Watching" });
    state.people.value = [create(PersonSchema, { id: 1, name: "Ann", steers: true })];
    state.picture.value = { ...picture, exact: true };
    expect(badgeOf(state, 0)).toMatchObject({ kind: "watching", label: "Watching, exact" });
    expect(badgeOf(state, 0).detail).toMatch(/^Ann steers this view\./);
    state.connection.value = { kind: "lost", retryAt: 5000, reason: "closed" };
    expect(badgeOf(state, 0).kind).toBe("reconnecting");
  });

  it("waits for data before the first picture", () => {
    const state = connected();
    state.picture.value = undefined;
    expect(badgeOf(state, 0).kind).toBe("waiting");
    expect(badgeOf(createAppState(), 0).kind).toBe("connecting");
  });
});

describe("notices", () => {
  it("are bounded, unique and can be dismissed", () => {
    const state = createAppState();
    for (const text of ["a", "b", "a", "c", "d", "e"]) notify(state, "error", text);
    expect(state.notices.value.map((n) => n.text)).toEqual(["a", "c", "d", "e"]);
    dismiss(state, state.notices.value[0]?.id ?? 0);
    expect(state.notices.value.map((n) => n.text)).toEqual(["c", "d", "e"]);
  });
});
