import { describe, expect, it } from "vitest";
import { frameOf, type Orbit } from "./camera";
import { wheelFactor } from "./camera_control";
import { meaningOf } from "./keyboard";
import { rolled } from "./turning";

const orbit: Orbit = {
  target: [0, 0, 0],
  axis: [0, 0, 1],
  yaw: 0,
  pitch: 0,
  distance: 5,
  fovyDegrees: 35,
  orthographic: false,
};

const press = (key: string, more: Partial<KeyboardEvent> = {}) =>
  meaningOf({
    key,
    code: "",
    shiftKey: false,
    ctrlKey: false,
    metaKey: false,
    altKey: false,
    ...more,
  });

function moved(key: string, more: Partial<KeyboardEvent> = {}): Orbit {
  const meaning = press(key, more);
  if (!meaning || !("move" in meaning)) throw new Error(`${key} does not move the camera`);
  return meaning.move(orbit);
}

describe("keys", () => {
  it("turn with arrows and pan with Shift", () => {
    expect(moved("ArrowRight").yaw).toBeLessThan(0);
    expect(moved("ArrowDown").pitch).toBeGreaterThan(0);
    const panned = moved("ArrowUp", { shiftKey: true });
    expect(panned.yaw).toBe(0);
    expect(panned.target[2]).toBeLessThan(0);
  });

  it("turn as hands do", () => {
    const meaning = meaningOf(
      { key: "ArrowUp", code: "", shiftKey: false, ctrlKey: false, metaKey: false, altKey: false },
      rolled,
    );
    if (!meaning || !("move" in meaning)) throw new Error("the arrow does not move the camera");
    expect(meaning.move(orbit)).toEqual(rolled(orbit, 0, -Math.PI / 36, 1));
  });

  it("dolly, look along axes and change projection", () => {
    expect(moved("+").distance).toBeLessThan(5);
    expect(moved("-").distance).toBeGreaterThan(5);
    expect(frameOf(moved("y", { code: "KeyZ" })).toEye[1]).toBeCloseTo(1, 12);
    expect(frameOf(moved('"', { code: "Digit2", shiftKey: true })).toEye[1]).toBeCloseTo(-1, 12);
    expect(moved("p").orthographic).toBe(true);
  });

  it("name the other actions and leave the browser its own", () => {
    expect(press("r")).toEqual({ do: "reset" });
    expect(press("?", { shiftKey: true })).toEqual({ do: "help" });
    expect(press("z", { ctrlKey: true, code: "KeyZ" })).toEqual({ do: "undo" });
    expect(press("Z", { ctrlKey: true, shiftKey: true })).toEqual({ do: "redo" });
    expect(press("y", { metaKey: true })).toEqual({ do: "redo" });
    expect(press("r", { ctrlKey: true })).toBeUndefined();
    expect(press("ArrowLeft", { altKey: true })).toBeUndefined();
    expect(press("H")).toEqual({ do: "hud" });
    expect(press("h", { ctrlKey: true })).toBeUndefined();
    for (const key of ["q", "w", "a", "s", "d", "e"]) expect(press(key)).toBeUndefined();
  });
});

describe("wheel", () => {
  it("is its own inverse, bounded, and knows lines and pixels", () => {
    const at = (deltaY: number, deltaMode = 0, ctrlKey = false) =>
      wheelFactor({ deltaY, deltaMode, ctrlKey });
    expect(at(100) * at(-100)).toBeCloseTo(1, 12);
    expect(at(3, 1)).toBeCloseTo(at(48), 12);
    expect(at(1e9)).toBe(at(400));
    expect(at(10, 0, true)).toBeGreaterThan(at(10));
  });
});
