import { describe, expect, it } from "vitest";
import { OpacityCurve, type OpacityPoint } from "./opacity_curve";
import { knotsOf, type Spline, withoutIdleKnots, withoutPointOf, withPointOn } from "./spline";

const pointsOf = (...xy: readonly (readonly [number, number])[]): OpacityPoint[] =>
  xy.map(([position, opacity]) => ({ position, opacity }));

const kBent: Spline = {
  points: pointsOf([0, 0], [0.1, 0.9], [0.35, 0.1], [0.4, 0.8], [0.8, 0], [1, 1]),
};

/** y(x) of a spline, wherever its parts meet. */
function heightAt(spline: Spline, x: number): number {
  const curve = new OpacityCurve(spline.points, 3, spline.knots);
  for (let span = 0; span < curve.spans; span += 1) {
    if (x <= curve.joint(span + 1).position) return curve.at(span, x);
  }
  return curve.joint(curve.spans).opacity;
}

function expectSame(a: Spline, b: Spline): void {
  for (let i = 0; i <= 200; i += 1) {
    expect(heightAt(b, i / 200), `at ${i / 200}`).toBeCloseTo(heightAt(a, i / 200), 12);
  }
}

describe("a point that is added to a spline", () => {
  it.each([2, 3, 4, 5, 6])("of %i points leaves the curve as it is", (count) => {
    const points = [...kBent.points.slice(0, count - 1), ...pointsOf([1, 1])];
    const { spline, index } = withPointOn({ points }, 0.37);
    expect(spline.points).toHaveLength(count + 1);
    expect(index).toBeGreaterThan(0);
    expect(index).toBeLessThan(count);
    expectSame({ points }, spline);
  });

  it("lies where it was asked for, on the line between its neighbours", () => {
    const { spline, index } = withPointOn(kBent, 0.2);
    expect(spline.points[index]?.position).toBeCloseTo(0.2, 12);
    expect(spline.points[index]?.opacity).toBeCloseTo(0.9 - 0.8 * 0.4, 12);
    expect(spline.points[0]).toBe(kBent.points[0]);
    expect(spline.points[6]).toBe(kBent.points[5]);
  });

  it("is the one that is there, or the end's beyond it", () => {
    for (const [x, index] of [
      [0, 0],
      [0.4, 3],
      [1, 5],
      [-3, 0],
      [7, 5],
    ] as const) {
      expect(withPointOn(kBent, x)).toEqual({ spline: kBent, index });
    }
  });

  it("goes anywhere and many times, and its knots stay apart", () => {
    let spline = kBent;
    for (let i = 0; i < 60; i += 1) spline = withPointOn(spline, (i * 0.618) % 1).spline;
    for (let i = 0; i < 3; i += 1) {
      const [a, b] = [spline.points[2], spline.points[3]];
      spline = withPointOn(spline, ((a?.position ?? 0) + (b?.position ?? 0)) / 2).spline;
    }
    expect(spline.points.length).toBeGreaterThan(60);
    const knots = knotsOf(spline);
    expect(knots).toHaveLength(spline.points.length - 2);
    knots.slice(1).forEach((knot, i) => {
      expect(knot).toBeGreaterThan(knots[i] ?? knot);
    });
    expectSame(kBent, spline);
  });

  it("bends the curve about it alone when it is moved", () => {
    const many = {
      points: Array.from({ length: 12 }, (_, i) => ({ position: i / 11, opacity: 0.2 })),
    };
    const { spline, index } = withPointOn(many, 0.5);
    const points = spline.points.map((p, i) => (i === index ? { ...p, opacity: 0.8 } : p));
    const moved = { ...spline, points };
    expect(heightAt(moved, 0.5)).toBeGreaterThan(0.4);
    expect(heightAt(moved, 0.15)).toBe(0.2);
    expect(heightAt(moved, 0.85)).toBe(0.2);
  });
});

describe("what is drawn of a spline", () => {
  it("has no knots that change nothing, in whatever order they came", () => {
    let spline = kBent;
    for (const x of [0.37, 0.05, 0.62, 0.36, 0.95, 0.38]) spline = withPointOn(spline, x).spline;
    expect(spline.points).toHaveLength(12);
    const drawn = withoutIdleKnots(spline);
    expect(drawn.knots).toBeUndefined();
    drawn.points.forEach((point, i) => {
      expect(point.position).toBeCloseTo(kBent.points[i]?.position ?? -1, 13);
      expect(point.opacity).toBeCloseTo(kBent.points[i]?.opacity ?? -1, 13);
    });
  });

  it("keeps the knot of a point that was moved by little, and knots that were always there", () => {
    const { spline, index } = withPointOn(kBent, 0.37);
    const points = spline.points.map((p, i) =>
      i === index ? { ...p, opacity: p.opacity + 1e-6 } : p,
    );
    expect(withoutIdleKnots({ ...spline, points }).points).toHaveLength(7);
    const line = {
      points: Array.from({ length: 7 }, (_, i) => ({ position: i / 6, opacity: i / 9 })),
    };
    expect(withoutIdleKnots(line)).toEqual(line);
  });
});

describe("a point that is removed from a spline", () => {
  it("leaves the curve where it was added and not moved", () => {
    for (const x of [0.03, 0.22, 0.37, 0.5, 0.93]) {
      const { spline, index } = withPointOn(kBent, x);
      const again = withoutPointOf(spline, index);
      expect(again.points).toHaveLength(6);
      expect(again.knots).toBeUndefined();
      expectSame(kBent, again);
    }
  });

  it("takes its knot along where it was moved, and the curve stays a curve", () => {
    const { spline, index } = withPointOn(kBent, 0.37);
    const points = spline.points.map((p, i) => (i === index ? { ...p, opacity: 0.9 } : p));
    for (let i = 1; i < 6; i += 1) {
      const fewer = withoutPointOf({ ...spline, points }, i);
      expect(fewer.points).toEqual(points.filter((_, k) => k !== i));
      expect(knotsOf(fewer)).toHaveLength(4);
      for (let x = 0; x <= 1; x += 0.01) expect(heightAt(fewer, x)).not.toBeNaN();
    }
  });

  it("is followed by uniform knots where none were inserted", () => {
    expect(withoutPointOf(kBent, 2)).toEqual({ points: kBent.points.filter((_, i) => i !== 2) });
  });
});
