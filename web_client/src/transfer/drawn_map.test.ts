import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { type DrawnMap, fromTable, kOpacityError, resolved } from "./drawn_map";
import { opacityFromExtinction } from "./opacity";
import { sampleAt, type TransferFunction } from "./transfer_function";

interface Row {
  readonly name: string;
  readonly colours?: readonly [number, number, number, number][];
  readonly opacities?: readonly [number, number][];
  readonly degree?: 1 | 3;
  readonly rgba?: readonly [number, number, number, number][];
  readonly distance: number;
  readonly window: readonly [number, number];
  readonly expected: readonly [number, number, number, number, number][];
}

const file = new URL("../../../tests/support/maps/drawn_maps.json", import.meta.url);
const rows = JSON.parse(readFileSync(file, "utf8")) as Row[];

const drawnOf = (row: Row): DrawnMap => ({
  colours: (row.colours ?? []).map(([position, r, g, b]) => ({ position, colour: { r, g, b } })),
  opacities: (row.opacities ?? []).map(([position, opacity]) => ({ position, opacity })),
  degree: row.degree ?? 3,
  distance: row.distance,
});

function resolvedOf(row: Row): TransferFunction {
  const window = { first: row.window[0], last: row.window[1] };
  return row.rgba ? fromTable(row.rgba, row.distance, window) : resolved(drawnOf(row), window);
}

describe("drawn map", () => {
  it("is what the rational splines say, as in C++", () => {
    for (const row of rows) {
      const map = resolvedOf(row);
      expect(map.length).toBeLessThan(600);
      for (const [value, opacity, ...rgb] of row.expected) {
        const found = sampleAt(map, value);
        const says = `${row.name} at ${value}`;
        const error = Math.abs(opacityFromExtinction(found.extinction, row.distance) - opacity);
        expect(error, says).toBeLessThan(kOpacityError);
        const { r, g, b } = found.colour;
        [r, g, b].forEach((c, i) => {
          expect(c, says).toBeCloseTo(rgb[i] ?? Number.NaN, 9);
        });
      }
    }
    expect(rows.length).toBeGreaterThan(10);
  });

  it("ascends, whichever way its window runs", () => {
    for (const row of rows) {
      const values = resolvedOf(row).map((p) => p.value);
      expect(values).toEqual([...values].sort((a, b) => a - b));
    }
  });
});
