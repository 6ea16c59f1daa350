import { describe, expect, it } from "vitest";
import { alongAxis, dragged, frameOf, type Orbit, poseFrom } from "./camera";
import { levelled, looked, rolled } from "./turning";
import { dot, length, subtract, type Vec3 } from "./vec3";

const orbit: Orbit = {
  target: [1, 2, 3],
  axis: [0, 0, 1],
  yaw: 0.4,
  pitch: 0.3,
  distance: 10,
  fovyDegrees: 40,
  orthographic: false,
};
const close = (a: Vec3, b: Vec3): void => {
  for (const i of [0, 1, 2] as const) expect(a[i]).toBeCloseTo(b[i], 9);
};

describe("trackball", () => {
  it("turns in the hand's direction by the hand's angle", () => {
    const before = frameOf(orbit);
    const after = frameOf(rolled(orbit, 30, -40, 0.01));
    expect(dot(before.toEye, after.toEye)).toBeCloseTo(Math.cos(0.5), 12);
    // What faces the eye goes with the hand: right, and up on the screen.
    expect(dot(before.toEye, after.right)).toBeCloseTo(0.6 * Math.sin(0.5), 12);
    expect(dot(before.toEye, after.up)).toBeCloseTo(0.8 * Math.sin(0.5), 12);
    expect(dot(after.up, after.toEye)).toBeCloseTo(0, 12);
    expect(length(after.up)).toBeCloseTo(1, 12);
  });

  it("is a turntable's turn at its equator", () => {
    const level = { ...orbit, pitch: 0 };
    close(frameOf(rolled(level, 25, 0, 0.01)).toEye, frameOf(dragged(level, 25, 0, 0.01)).toEye);
    close(frameOf(rolled(level, 0, 25, 0.01)).toEye, frameOf(dragged(level, 0, 25, 0.01)).toEye);
  });

  it("goes over the poles and comes back after ten whole turns", () => {
    let turned: Orbit = orbit;
    for (let i = 0; i < 360; i += 1) turned = rolled(turned, 0, 10, Math.PI / 180);
    close(frameOf(turned).toEye, frameOf(orbit).toEye);
    close(frameOf(turned).up, frameOf(orbit).up);
    expect(rolled(orbit, 0, 0, 0.01)).toBe(orbit);
  });

  it("stands upright again where one asks for it", () => {
    const tilted = rolled(rolled(orbit, 40, 30, 0.01), -20, 50, 0.01);
    const upright = levelled(tilted, [0, 0, 1]);
    close(frameOf(upright).toEye, frameOf(tilted).toEye);
    expect(frameOf(upright).right[2]).toBeCloseTo(0, 12);
    close(frameOf(alongAxis(rolled(orbit, 5, 9, 0.01), 0, false)).up, [0, 0, 1]);
  });
});

describe("looking around", () => {
  it("keeps the eye and moves the picture with the hand", () => {
    const next = looked(orbit, 10, 0, 0.01);
    close(poseFrom(next).eye, poseFrom(orbit).eye);
    const offset = subtract(orbit.target, poseFrom(next).eye);
    expect(dot(offset, frameOf(next).right)).toBeCloseTo(10 * Math.cos(0.3) * Math.sin(0.1), 9);
    const down = looked(orbit, 0, 10, 0.01);
    const below = subtract(orbit.target, poseFrom(down).eye);
    expect(dot(below, frameOf(down).up)).toBeCloseTo(-10 * Math.sin(0.1), 9);
  });
});
