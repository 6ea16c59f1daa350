#!/usr/bin/env python3
"""Writes drawn_maps.json: maps as editors draw them, and what they are at some values.

usage: make_drawn_maps.py > drawn_maps.json

Read by the C++ and the TypeScript tests. Written apart from both: B-splines as sums of basis
functions (Cox and de Boor's recursion) in rational numbers, solved by halving.
"""

import json
import math
import random
from fractions import Fraction

MOST_OPACITY = 1 - 2**-24
HALVINGS = 60


def basis(i, degree, u, knots):
    if degree == 0:
        last = knots[i + 1] == knots[-1] and u == knots[-1]
        return Fraction(1) if knots[i] <= u < knots[i + 1] or (last and knots[i] < u) else Fraction(0)
    total = Fraction(0)
    if knots[i + degree] > knots[i]:
        total += (u - knots[i]) / (knots[i + degree] - knots[i]) * basis(i, degree - 1, u, knots)
    if knots[i + degree + 1] > knots[i + 1]:
        total += ((knots[i + degree + 1] - u) / (knots[i + degree + 1] - knots[i + 1])
                  * basis(i + 1, degree - 1, u, knots))
    return total


def opacity_at(points, degree, position):
    degree = min(degree, len(points) - 1)
    if position <= points[0][0]:
        return points[0][1]
    if position >= points[-1][0]:
        return points[-1][1]
    spans = len(points) - degree
    knots = [Fraction(k) for k in [0] * degree + list(range(spans + 1)) + [spans] * degree]

    def along(axis, u):
        weights = [basis(i, degree, u, knots) for i in range(len(points))]
        return sum(w * Fraction(p[axis]) for w, p in zip(weights, points))

    low, high = Fraction(0), Fraction(spans)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if along(0, middle) < position:
            low = middle
        else:
            high = middle
    return float(along(1, low))


def colour_at(points, position):
    before = [p for p in points if p[0] <= position]
    after = [p for p in points if p[0] > position]
    if not before or not after:
        return list((before[-1] if before else after[0])[1:])
    (x0, *c0), (x1, *c1) = before[-1], after[0]
    t = (position - x0) / (x1 - x0)
    return [a + t * (b - a) for a, b in zip(c0, c1)]


def row(name, colours, opacities, degree, distance=1.0, window=(0.0, 1.0), probes=23):
    """`expected`: value, opacity over the distance, linear red, green, blue."""
    expected = []
    for i in range(probes):
        position = (i + 0.37) / probes
        value = window[0] + (window[1] - window[0]) * position
        opacity = min(opacity_at(opacities, degree, position), MOST_OPACITY)
        expected.append([value, opacity, *colour_at(colours, position)])
    return {"name": name, "colours": colours, "opacities": opacities, "degree": degree,
            "distance": distance, "window": list(window), "expected": expected}


def table(name, rgba, distance, window, probes=23):
    expected = []
    for i in range(probes):
        position = (i + 0.37) / probes
        place = position * (len(rgba) - 1)
        at = min(int(place), max(len(rgba) - 2, 0))
        near, far = rgba[at], rgba[min(at + 1, len(rgba) - 1)]
        t = place - at
        depth = [-math.log1p(-min(c[3], MOST_OPACITY)) for c in (near, far)]
        mixed = [a + t * (b - a) for a, b in zip(near[:3], far[:3])]
        opacity = -math.expm1(-(depth[0] + t * (depth[1] - depth[0])))
        expected.append([window[0] + (window[1] - window[0]) * position, opacity, *mixed])
    return {"name": name, "rgba": rgba, "distance": distance, "window": list(window),
            "expected": expected}


def random_points(count, seed):
    chance = random.Random(seed)
    places = sorted(round(chance.random(), 6) for _ in range(count))
    return [[x, round(chance.random(), 6)] for x in places]


def main():
    white = [[0.0, 1.0, 1.0, 1.0]]
    fire = [[0.0, 0.0, 0.0, 0.0], [0.4, 1.0, 0.1, 0.0], [1.0, 1.0, 1.0, 0.6]]
    hill = [[0.0, 0.0], [0.2, 0.1], [0.45, 0.95], [0.6, 0.2], [0.85, 0.7], [1.0, 0.0]]
    rows = [
        row("one point", white, [[0.5, 0.3]], 3),
        row("two points are a line", white, [[0.1, 0.2], [0.8, 0.9]], 3),
        row("three points are a parabola", fire, [[0.0, 0.0], [0.2, 1.0], [1.0, 0.1]], 3),
        row("four points are one cubic", fire, [[0.0, 0.1], [0.1, 0.9], [0.2, 0.0], [1.0, 0.8]], 3),
        row("a curve over three colours", fire, hill, 3, 0.25, (-1000.0, 3000.0)),
        row("straight lines over three colours", fire, hill, 1, 4.0, (-0.001, 0.002)),
        row("an inverted window", fire, hill, 3, 1.0, (200.0, -50.0)),
        row("steps in colour and opacity",
            [[0.0, 1.0, 0.0, 0.0], [0.5, 1.0, 0.0, 0.0], [0.5, 0.0, 0.0, 1.0]],
            [[0.0, 0.1], [0.3, 0.1], [0.3, 0.8], [1.0, 0.4]], 1),
        row("crowded points stand upright", white,
            [[0.0, 0.0], [0.5, 0.1], [0.5, 0.5], [0.5, 0.9], [1.0, 1.0]], 3),
        row("up to full opacity", white, [[0.0, 0.0], [0.7, 1.0], [0.8, 1.0], [0.9, 1.0], [1.0, 1.0]], 3),
        table("a table", [[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.5], [1.0, 1.0, 0.0, 0.1],
                          [1.0, 1.0, 1.0, 1.0]], 2.0, (10.0, 20.0)),
        table("a table of one entry", [[0.2, 0.4, 0.6, 0.5]], 1.0, (0.0, 1.0)),
    ]
    for count, seed in ((5, 1), (9, 2), (17, 3), (40, 4)):
        rows.append(row(f"{count} points by chance", fire, random_points(count, seed), 3, probes=41))
    print("[")
    print(",\n".join(json.dumps(r) for r in rows))
    print("]")


if __name__ == "__main__":
    main()
