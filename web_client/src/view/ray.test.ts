import { describe, expect, it } from "vitest";
import { type Orbit, orbitFrom } from "./camera";
import { projected } from "./project";
import { placeOnLine, rayThrough } from "./ray";
import { add, dot, length, subtract, times, type Vec3 } from "./vec3";

const look = (orthographic: boolean): Orbit =>
  orbitFrom({
    eye: [3, -4, 2],
    center: [0.5, 0.25, 0],
    up: [0, 0, 1],
    orthographic,
    fovyDegrees: 40,
    orthographicHeight: 3,
  });

describe.each([false, true])("with an orthographic camera: %s", (flat) => {
  it("a ray goes through what falls on its point", () => {
    const orbit = look(flat);
    const point: Vec3 = [0.2, 0.6, -0.4];
    const at = projected(orbit, point);
    if (!at) throw new Error("the point is in front of the eye");
    const { origin, direction } = rayThrough(orbit, at);
    expect(length(direction)).toBeCloseTo(1, 12);
    const offset = subtract(point, origin);
    const along = dot(offset, direction);
    expect(along).toBeGreaterThan(0);
    expect(length(subtract(offset, times(direction, along)))).toBeLessThan(1e-12);
  });

  it("a place on a line is found from where it falls", () => {
    const orbit = look(flat);
    const from: Vec3 = [0.1, 0.2, 0.3];
    for (const along of [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ] as const) {
      const at = projected(orbit, add(from, times(along, 0.7)));
      if (!at) throw new Error("the place is in front of the eye");
      expect(placeOnLine(rayThrough(orbit, at), from, along)).toBeCloseTo(0.7, 9);
    }
  });

  it("nothing is said of a line that is looked along", () => {
    const orbit = look(flat);
    const ray = rayThrough(orbit, { x: 0, y: 0 });
    expect(placeOnLine(ray, [0, 0, 0], ray.direction)).toBeUndefined();
  });
});
