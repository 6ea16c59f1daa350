import { describe, expect, it } from "vitest";
import {
  alongAxis,
  type Bounds,
  dollied,
  dragged,
  fitted,
  frameOf,
  heightAtTarget,
  type Orbit,
  orbitFrom,
  panned,
  poseFrom,
  withOtherProjection,
} from "./camera";
import { add, cross, dot, length, subtract, times, type Vec3 } from "./vec3";

const orbit: Orbit = {
  target: [1, 2, 3],
  axis: [0, 0, 1],
  yaw: 0.4,
  pitch: 0.3,
  distance: 10,
  fovyDegrees: 40,
  orthographic: false,
};
const bounds: Bounds = { min: [-1, -1, -1], max: [3, 5, 7] };

const close = (a: Vec3, b: Vec3): void => {
  for (const i of [0, 1, 2] as const) expect(a[i]).toBeCloseTo(b[i], 9);
};

/** Where a world point falls, in CSS pixels from the middle of a picture `height` pixels high. */
function project(o: Orbit, point: Vec3, height: number): [number, number] {
  const { toEye, up, right } = frameOf(o);
  const pose = poseFrom(o);
  const offset = subtract(point, pose.eye);
  const depth = -dot(offset, toEye);
  const tangent = Math.tan((o.fovyDegrees * Math.PI) / 360);
  const scale = height / (o.orthographic ? heightAtTarget(o) : 2 * depth * tangent);
  return [dot(offset, right) * scale, -dot(offset, up) * scale];
}

describe("camera", () => {
  it("has a right-handed unit frame everywhere", () => {
    for (const axis of [
      [0, 0, 1],
      [0, 1, 0],
      [1, 0, 0],
      [0.6, 0, 0.8],
    ] as Vec3[]) {
      for (const pitch of [-Math.PI / 2, -0.7, 0, 1.2, Math.PI / 2]) {
        const { toEye, up, right } = frameOf({ ...orbit, axis, pitch });
        expect(length(up)).toBeCloseTo(1, 12);
        expect(dot(up, toEye)).toBeCloseTo(0, 12);
        close(cross(right, up), toEye);
      }
    }
  });

  it("reads back the pose that it writes", () => {
    const level = { ...orbit, pitch: 0 };
    const again = orbitFrom(poseFrom(level));
    close(again.target, level.target);
    expect(again.yaw).toBeCloseTo(level.yaw, 12);
    expect(again.distance).toBeCloseTo(level.distance, 12);
    close(poseFrom(again).eye, poseFrom(level).eye);
  });

  it("keeps a given pose, with up as the turntable's axis", () => {
    const pose = { ...poseFrom(orbit), up: [0, 0, 1] as Vec3 };
    const read = orbitFrom(pose);
    close(poseFrom(read).eye, pose.eye);
    expect(read.pitch).toBeCloseTo(0.3, 12);
  });

  it("turns with the hand and stops at the poles", () => {
    const turned = dragged(orbit, 10, 5, 0.01);
    expect(turned.yaw).toBeCloseTo(0.3, 12);
    expect(turned.pitch).toBeCloseTo(0.35, 12);
    expect(dragged(orbit, 0, 1e6, 0.01).pitch).toBe(Math.PI / 2);
    expect(dragged(orbit, 0, -1e6, 0.01).pitch).toBe(-Math.PI / 2);
    expect(length(subtract(poseFrom(turned).eye, orbit.target))).toBeCloseTo(10, 12);
  });

  it("pans the target's depth with the hand", () => {
    const [x, y] = project(panned(orbit, 30, -12, 500), orbit.target, 500);
    expect(x).toBeCloseTo(30, 9);
    expect(y).toBeCloseTo(-12, 9);
  });

  it.each([false, true])("dollies towards the cursor (orthographic: %s)", (orthographic) => {
    const o = { ...orbit, orthographic };
    const { up, right } = frameOf(o);
    const unit = heightAtTarget(o) / 500;
    const under = add(o.target, add(times(right, 80 * unit), times(up, 60 * unit)));
    const [x, y] = project(dollied(o, 0.5, { x: 80, y: -60 }, 500), under, 500);
    expect(x).toBeCloseTo(80, 9);
    expect(y).toBeCloseTo(-60, 9);
    expect(dollied(o, 0.5, { x: 0, y: 0 }, 500).distance).toBe(5);
  });

  it.each([0.4, 1, 3])("fits all corners at aspect %s", (aspect) => {
    for (const orthographic of [false, true]) {
      const o = fitted({ ...orbit, orthographic }, bounds, aspect);
      for (let corner = 0; corner < 8; corner += 1) {
        const at = [0, 1, 2].map((i) => (corner & (1 << i) ? bounds.max : bounds.min)[i]);
        const [x, y] = project(o, at as unknown as Vec3, 2);
        expect(Math.abs(x)).toBeLessThanOrEqual(aspect * (1 + 1e-9));
        expect(Math.abs(y)).toBeLessThanOrEqual(1 + 1e-9);
      }
    }
  });

  it("shows the same height at the target in both projections", () => {
    const flat = poseFrom(withOtherProjection(orbit), bounds);
    expect(flat.orthographicHeight).toBeCloseTo(20 * Math.tan((20 * Math.PI) / 180), 12);
    close(poseFrom(withOtherProjection(withOtherProjection(orbit))).eye, poseFrom(orbit).eye);
  });

  it("keeps an orthographic eye outside the data", () => {
    const near = { ...orbit, orthographic: true, distance: 1e-3 };
    const { toEye } = frameOf(near);
    const eye = poseFrom(near, bounds).eye;
    for (let corner = 0; corner < 8; corner += 1) {
      const at = [0, 1, 2].map((i) => (corner & (1 << i) ? bounds.max : bounds.min)[i]);
      expect(dot(subtract(eye, at as unknown as Vec3), toEye)).toBeGreaterThan(0);
    }
  });

  it("looks along each axis from both sides", () => {
    for (const axis of [0, 1, 2] as const) {
      for (const negative of [false, true]) {
        const { toEye } = frameOf(alongAxis(orbit, axis, negative));
        expect(toEye[axis]).toBeCloseTo(negative ? -1 : 1, 12);
      }
    }
  });
});
