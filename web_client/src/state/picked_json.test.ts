import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { DatasetInfoSchema, PickedSchema } from "../net/gen/volcast/v1/session_pb";
import { pickedJson } from "./picked_json";

describe("a probe as JSON", () => {
  it("has values with units, the place, and the cell", () => {
    const picked = create(PickedSchema, {
      x: 3,
      y: 4,
      layer: "main",
      values: [
        { field: "T", value: -1.5 },
        { field: "id", value: 7 },
      ],
      position: { x: 1, y: -2.5, z: 0 },
      distance: 3.25,
      cell: 0,
      colour: { r: 1, g: 0, b: 0 },
    });
    const dataset = create(DatasetInfoSchema, {
      id: "a/b.vtu",
      fields: [{ name: "T", unit: "K" }, { name: "id" }],
    });
    expect(JSON.parse(pickedJson(picked, dataset))).toEqual({
      dataset: "a/b.vtu",
      layer: "main",
      values: [
        { field: "T", value: -1.5, unit: "K" },
        { field: "id", value: 7 },
      ],
      position: [1, -2.5, 0],
      distance: 3.25,
      cell: 0,
      colour: "#ff0000",
      pixel: [3, 4],
    });
  });

  it("has the voxel of a volume", () => {
    const picked = create(PickedSchema, { layer: "main", voxel: [1, 0, 67] });
    const json = JSON.parse(pickedJson(picked, undefined));
    expect(json.voxel).toEqual([1, 0, 67]);
    expect("cell" in json).toBe(false);
  });
});
