import { expect, it } from "vitest";
import { frameOf, type Orbit } from "../view/camera";
import { dot } from "../view/vec3";
import { picturesWithin, turnOf } from "./recording";

const start: Orbit = {
  target: [1, 2, 3],
  axis: [0.6, 0, 0.8],
  yaw: 1,
  pitch: 0.2,
  distance: 10,
  fovyDegrees: 40,
  orthographic: false,
};

it("turns once about the upright axis in even steps", () => {
  const turn = turnOf(start, [0, 0, 1], 8);
  expect(turn).toHaveLength(8);
  const first = turn[0];
  if (!first) throw new Error("no first camera");
  const begin = frameOf(first).toEye;
  expect(dot(begin, frameOf(start).toEye)).toBeCloseTo(1, 12);
  for (const [i, orbit] of [...turn, first].entries()) {
    const { toEye, right } = frameOf(orbit);
    expect(toEye[2]).toBeCloseTo(begin[2], 12);
    expect(right[2]).toBeCloseTo(0, 12);
    const level = 1 - begin[2] * begin[2];
    expect(dot(begin, toEye) - begin[2] * toEye[2]).toBeCloseTo(
      level * Math.cos((i * Math.PI) / 4),
      9,
    );
  }
});

it("has a number of pictures that can be recorded", () => {
  expect([Number.NaN, -3, 1, 60.4, 1e9].map(picturesWithin)).toEqual([2, 2, 2, 60, 720]);
});
