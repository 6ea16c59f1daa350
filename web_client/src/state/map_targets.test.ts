import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { LayerSchema, RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { DatasetInfoSchema, FieldInfoSchema } from "../net/gen/volcast/v1/session_pb";
import { kColourMaps } from "../transfer/colour_maps";
import { kOpacityError } from "../transfer/drawn_map";
import { opacityFromExtinction } from "../transfer/opacity";
import { withColourMap } from "../transfer/presets";
import { sampleAt } from "../transfer/transfer_function";
import { changePart, changeRange, changeSmooth, drawnMap, mapEditOf, undo } from "./actions";
import { createAppState } from "./app_state";
import { startHistory } from "./history";
import { addPoint, changePoints, pointsOf, removePoint, targetsOf } from "./map_targets";

const grey = (x: number) => ({ r: x, g: x, b: x });
const map = [0, 1, 2, 4, 6, 10].map((value, i) => ({
  value,
  colour: grey(i / 5),
  extinction: (7 * i) % 5,
}));

function opened() {
  const state = createAppState();
  const max = { x: 3, y: 4, z: 12 };
  const fields = [create(FieldInfoSchema, { name: "f", min: 0, max: 10 })];
  state.datasets.value = [
    create(DatasetInfoSchema, { id: "d", boundsMin: { x: 0 }, boundsMax: max, fields }),
  ];
  const model = RayModel.VOLUME;
  const layers = [create(LayerSchema, { id: "a", dataset: "d", field: "f", model })];
  const scene = create(SceneSchema, { layers });
  state.edit.value = startHistory({ scene, map, density: 1 });
  return state;
}

describe("a smooth map", () => {
  it("has points of its own for its opacities, those that it had", () => {
    const state = opened();
    changeSmooth(state, true);
    expect(targetsOf(state, "first").map((t) => t.part)).toEqual(["opacities", "colours"]);
    expect(pointsOf(state, "first", "opacities").map((p) => p.extinction)).toEqual(
      map.map((p) => p.extinction),
    );
    changeSmooth(state, false);
    expect(mapEditOf(state).apart?.opacities).toHaveLength(6);
  });

  it("is drawn as before with points added and removed, and otherwise with one moved", () => {
    const state = opened();
    changeSmooth(state, true);
    const before = drawnMap(state);
    const index = addPoint(state, "first", "opacities", 3);
    const points = pointsOf(state, "first", "opacities");
    expect(points[index]?.value).toBeCloseTo(3, 12);
    expect(mapEditOf(state).apart?.knots).toHaveLength(5);
    expect(drawnMap(state).length).toBe(before.length);
    drawnMap(state).forEach((point, i) => {
      expect(point.extinction).toBeCloseTo(before[i]?.extinction ?? -1, 12);
    });
    removePoint(state, "first", "opacities", index);
    expect(mapEditOf(state).apart?.knots).toBeUndefined();
    undo(state);
    const moved = points.map((p, i) => (i === index ? { ...p, extinction: 9 } : p));
    changePoints(state, "first", "opacities", moved);
    expect(mapEditOf(state).apart?.knots).toHaveLength(5);
    expect(sampleAt(drawnMap(state), 3).extinction).toBeGreaterThan(
      sampleAt(before, 3).extinction + 0.1,
    );
  });

  it("keeps its curve under other colours, and turns round with its knots", () => {
    const state = opened();
    changeSmooth(state, true);
    const index = addPoint(state, "first", "opacities", 3);
    const points = pointsOf(state, "first", "opacities");
    const moved = points.map((p, i) => (i === index ? { ...p, extinction: 9 } : p));
    changePoints(state, "first", "opacities", moved);
    const before = drawnMap(state);
    const [colours] = kColourMaps;
    if (colours) changePart(state, "colours", (part) => withColourMap(part, colours));
    const extinctionAt = (value: number) => sampleAt(drawnMap(state), value).extinction;
    for (const value of [0.5, 2.5, 3.3, 7]) {
      expect(extinctionAt(value)).toBeCloseTo(sampleAt(before, value).extinction, 9);
    }
    changeRange(state, 20, 0);
    for (const value of [0.5, 2.5, 3.3, 7]) {
      // Both are lines that follow one curve, each to kOpacityError.
      const length = state.referenceLength.value;
      const there = opacityFromExtinction(sampleAt(before, value).extinction, length);
      const here = opacityFromExtinction(extinctionAt(20 - 2 * value), length);
      expect(Math.abs(here - there)).toBeLessThan(2 * kOpacityError);
    }
  });
});
