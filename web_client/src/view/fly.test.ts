import { describe, expect, it } from "vitest";
import { frameOf, heightAtTarget, type Orbit, poseFrom } from "./camera";
import { flightOf, flown, isFlightKey } from "./fly";
import { dot, subtract } from "./vec3";

const orbit: Orbit = {
  target: [0, 0, 0],
  axis: [0, 0, 1],
  yaw: 0.2,
  pitch: 0.1,
  distance: 8,
  fovyDegrees: 30,
  orthographic: false,
};

describe("flying", () => {
  it("moves eye and target along the screen and into it", () => {
    const next = flown(orbit, { right: 0.5, up: -0.25, forward: 2 });
    const shift = subtract(poseFrom(next).eye, poseFrom(orbit).eye);
    const { right, up, toEye } = frameOf(orbit);
    const height = heightAtTarget(orbit);
    expect(dot(shift, right)).toBeCloseTo(0.5 * height, 9);
    expect(dot(shift, up)).toBeCloseTo(-0.25 * height, 9);
    expect(dot(shift, toEye)).toBeCloseTo(-2 * height, 9);
    expect(next.distance).toBe(orbit.distance);
  });

  it("comes closer in an orthographic view too", () => {
    const flat = { ...orbit, orthographic: true };
    const next = flown(flat, { right: 0, up: 0, forward: 0.5 });
    expect(next.distance).toBeCloseTo(8 * Math.exp(-0.5), 12);
    expect(next.target).toEqual(flat.target);
  });

  it("adds up the keys that are held, by time", () => {
    const half = flightOf(new Set(["KeyW", "KeyA"]), false, 0.05);
    const whole = flightOf(new Set(["KeyW", "KeyA"]), false, 0.1);
    expect(whole.forward).toBeCloseTo(2 * half.forward, 12);
    expect(whole.right).toBeLessThan(0);
    expect(flightOf(new Set(["KeyW", "KeyS"]), false, 0.1).forward).toBe(0);
    expect(flightOf(new Set(["KeyE"]), true, 0.1).up).toBeGreaterThan(whole.forward);
    expect(flightOf(new Set(["KeyW"]), false, 60)).toEqual(flightOf(new Set(["KeyW"]), false, 0.1));
    expect(isFlightKey("KeyW")).toBe(true);
    expect(isFlightKey("KeyR")).toBe(false);
  });
});
