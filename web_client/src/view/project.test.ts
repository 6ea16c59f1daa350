import { describe, expect, it } from "vitest";
import { type Bounds, heightAtTarget, type Orbit, panned } from "./camera";
import { boxEdges, projected } from "./project";

const orbit: Orbit = {
  target: [0, 0, 0],
  axis: [0, 0, 1],
  yaw: 0.5,
  pitch: 0.4,
  distance: 10,
  fovyDegrees: 40,
  orthographic: false,
};
const cube: Bounds = { min: [-1, -1, -1], max: [1, 1, 1] };

describe("projection to the picture", () => {
  it.each([false, true])(
    "has the target in the middle and follows the hand (%s)",
    (orthographic) => {
      const o = { ...orbit, orthographic };
      expect(projected(o, o.target)).toEqual({ x: expect.closeTo(0), y: expect.closeTo(0) });
      const moved = projected(panned(o, 30, -12, 600), o.target);
      expect(moved?.x).toBeCloseTo(30 / 600, 12);
      expect(moved?.y).toBeCloseTo(-12 / 600, 12);
    },
  );

  it("makes what is nearer larger in perspective alone", () => {
    const size = (o: Orbit, x: number): number => {
      const [a, b] = [projected(o, [x, -1, 0]), projected(o, [x, 1, 0])];
      return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
    };
    const facing = { ...orbit, yaw: 0, pitch: 0 };
    expect(size(facing, 0)).toBeCloseTo(2 / heightAtTarget(facing), 12);
    expect(size(facing, 5)).toBeCloseTo(4 / heightAtTarget(facing), 12);
    expect(size({ ...facing, orthographic: true }, 5)).toBeCloseTo(2 / heightAtTarget(facing), 12);
    expect(projected(facing, [11, 0, 0])).toBeUndefined();
  });
});

describe("a box", () => {
  it.each([false, true])("hides the three edges at its far corner (%s)", (orthographic) => {
    const edges = boxEdges({ ...orbit, orthographic }, cube);
    expect(edges).toHaveLength(12);
    const hidden = edges.filter((e) => e.hidden);
    expect(hidden).toHaveLength(3);
    const far = projected({ ...orbit, orthographic }, [-1, -1, -1]);
    for (const { from, to } of hidden) {
      const near = [from, to].map((p) => Math.hypot(p.x - (far?.x ?? 9), p.y - (far?.y ?? 9)));
      expect(Math.min(...near)).toBeCloseTo(0, 12);
    }
  });

  it("is cut where it passes the eye, and hides nothing from inside", () => {
    const inside = { ...orbit, distance: 0.5 };
    const edges = boxEdges(inside, cube);
    expect(edges.length).toBeGreaterThan(0);
    expect(edges.length).toBeLessThan(12);
    expect(edges.some((e) => e.hidden)).toBe(false);
    for (const { from, to } of edges) {
      for (const p of [from, to]) expect(Number.isFinite(p.x + p.y)).toBe(true);
    }
  });
});
