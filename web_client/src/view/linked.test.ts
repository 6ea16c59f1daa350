import { describe, expect, it } from "vitest";
import { dollied, dragged, type Orbit, panned } from "./camera";
import { linkedOrbit } from "./linked";

const home: Orbit = {
  target: [1, 2, 3],
  axis: [0, 0, 1],
  yaw: 0.1,
  pitch: 0.2,
  distance: 4,
  fovyDegrees: 35,
  orthographic: false,
};
const large: Orbit = { ...home, target: [10, 0, 0], distance: 40 };

describe("linked cameras", () => {
  it("are one and the same of the same data", () => {
    const orbit = dragged(home, 20, 10, 0.01);
    expect(linkedOrbit(orbit, home, { ...home, yaw: 2 })).toBe(orbit);
  });

  it("turn alike, and move by their data's size", () => {
    const moved = panned(dragged(home, 20, 10, 0.01), 30, 0, 100);
    const other = linkedOrbit(moved, home, large);
    expect([other.yaw, other.pitch, other.distance]).toEqual([moved.yaw, moved.pitch, 40]);
    other.target.forEach((c, i) => {
      expect(c - (large.target[i] ?? 0)).toBeCloseTo(
        10 * ((moved.target[i] ?? 0) - (home.target[i] ?? 0)),
        12,
      );
    });
  });

  it("go there and back again", () => {
    const near = dollied(home, 0.5, { x: 10, y: -5 }, 100);
    const back = linkedOrbit(linkedOrbit(near, home, large), large, home);
    expect(back.distance).toBeCloseTo(near.distance, 12);
    back.target.forEach((c, i) => {
      expect(c).toBeCloseTo(near.target[i] ?? 0, 12);
    });
  });
});
