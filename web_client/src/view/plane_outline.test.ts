import { describe, expect, it } from "vitest";
import { middleOf, offsetRange, planeOutline } from "./plane_outline";
import type { Vec3 } from "./vec3";

const kBox = { min: [0, 0, 0] as Vec3, max: [2, 4, 6] as Vec3 };

describe("the outline of a plane in a box", () => {
  it("across an axis is the box's rectangle there", () => {
    const outline = planeOutline({ normal: [0, 0, -1], offset: -1.5 }, kBox);
    expect(outline.length).toBe(4);
    expect(outline.every((p) => p[2] === 1.5)).toBe(true);
    const sides = outline.map((p, i) => {
      const next = outline[(i + 1) % 4] ?? p;
      return Math.abs(next[0] - p[0]) + Math.abs(next[1] - p[1]);
    });
    expect([...sides].sort()).toEqual([2, 2, 4, 4]);
  });

  it("that cuts off a corner is a triangle, and along the diagonal a hexagon", () => {
    const cube = { min: [0, 0, 0] as Vec3, max: [1, 1, 1] as Vec3 };
    expect(planeOutline({ normal: [1, 1, 1], offset: 0.5 }, cube).length).toBe(3);
    expect(planeOutline({ normal: [1, 1, 1], offset: 1.5 }, cube).length).toBe(6);
  });

  it("through corners has each of them once", () => {
    const cube = { min: [0, 0, 0] as Vec3, max: [1, 1, 1] as Vec3 };
    expect(planeOutline({ normal: [1, -1, 0], offset: 0 }, cube).length).toBe(4);
    expect(planeOutline({ normal: [0, 0, 1], offset: 1 }, cube).length).toBe(4);
  });

  it("is empty where the plane misses the box", () => {
    expect(planeOutline({ normal: [0, 1, 0], offset: 4.01 }, kBox)).toEqual([]);
  });
});

describe("a plane's handle", () => {
  it("is in the plane, before the middle of the box", () => {
    expect(middleOf({ normal: [0, -2, 0], offset: -2 }, kBox)).toEqual([1, 1, 3]);
  });

  it("goes from where the plane touches the box to where it leaves it", () => {
    expect(offsetRange([0, -1, 0], kBox)).toEqual([-4, 0]);
    expect(offsetRange([1, 1, 0], kBox)).toEqual([0, 6]);
  });
});
