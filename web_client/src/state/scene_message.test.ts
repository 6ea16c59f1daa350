import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import type { Orbit } from "../view/camera";
import { readDocument, writeDocument } from "./document";
import { cameraMessage, mapOf, orbitOf, sceneMessage } from "./scene_message";

const orbit: Orbit = {
  target: [1e6 + 0.125, 2, 3],
  axis: [0, 0, 1],
  yaw: 0.25,
  pitch: 0,
  distance: 4,
  fovyDegrees: 30,
  orthographic: false,
};
const white = { r: 1, g: 0.5, b: 0.25 };
const edit = { map: [{ value: 0.1, colour: white, extinction: 3 }], density: 0.5 };
const base = create(SceneSchema, {
  background: { r: 0.5, g: 0, b: 0 },
  layers: [
    { id: "a", dataset: "d", model: RayModel.MIP, stepWorld: 0.125 },
    { id: "b", dataset: "e", hidden: true },
  ],
});

describe("scene message", () => {
  it("keeps everything that the client does not edit", () => {
    const scene = sceneMessage(base, orbit, undefined, edit);
    expect(scene.background).toEqual(base.background);
    expect(scene.layers[1]).toEqual(base.layers[1]);
    expect(scene.layers[0]).toMatchObject({ id: "a", model: RayModel.MIP, stepWorld: 0.125 });
    expect(base.layers[0]?.transferFunction).toBeUndefined();
  });

  it("sends the map with its density, in double precision values", () => {
    const scene = sceneMessage(base, orbit, undefined, edit);
    const map = mapOf(scene.layers[0]?.transferFunction);
    expect(map).toEqual([{ value: 0.1, colour: white, extinction: 1.5 }]);
  });

  it("sends the second field's map, where there is one", () => {
    const second = { map: [{ value: 7, colour: white, extinction: 2 }], density: 3 };
    const scene = sceneMessage(base, orbit, undefined, { ...edit, second });
    expect(mapOf(scene.layers[0]?.densityFunction)[0]).toMatchObject({ value: 7, extinction: 6 });
    expect(scene.layers[1]?.densityFunction).toBeUndefined();
  });

  it("leaves the server's map where there is none to send", () => {
    const scene = sceneMessage(base, orbit, undefined, { map: [], density: 1 });
    expect(scene.layers[0]?.transferFunction).toBeUndefined();
  });

  it("reads its own camera back, digits far from the origin included", () => {
    const again = orbitOf(cameraMessage(orbit, undefined));
    expect(again.target).toEqual(orbit.target);
    expect(again.yaw).toBeCloseTo(orbit.yaw, 8);
    const flat = orbitOf(cameraMessage({ ...orbit, orthographic: true }, undefined));
    expect(flat.orthographic).toBe(true);
    expect(flat.distance).toBeCloseTo(4, 9);
  });
});

describe("view document", () => {
  const document = { scene: base, orbit, home: { ...orbit, yaw: 0 }, edit };

  it("comes back as it was", () => {
    const read = readDocument(writeDocument(document));
    expect(read?.orbit).toEqual(orbit);
    expect(read?.home.yaw).toBe(0);
    expect(read?.edit).toEqual(edit);
    expect(read?.scene).toEqual(base);
  });

  it("keeps the second map, and reads documents from before there was one", () => {
    const second = { map: edit.map, density: 2 };
    const read = readDocument(writeDocument({ ...document, edit: { ...edit, second } }));
    expect(read?.edit.second).toEqual(second);
    expect(readDocument(writeDocument(document))?.edit.second).toBeUndefined();
    const odd = { ...edit, second: { map: "x" } } as unknown as typeof edit;
    expect(readDocument(writeDocument({ ...document, edit: odd }))).toBeUndefined();
  });

  it("refuses what it did not write", () => {
    const text = writeDocument(document);
    for (const broken of [
      null,
      "",
      "null",
      "{}",
      "not json",
      text.slice(0, 40),
      text.replace('"version":1', '"version":2'),
      text.replace('"yaw":0.25', '"yaw":"x"'),
      text.replace('"scene":"', '"scene":"!'),
    ]) {
      expect(readDocument(broken)).toBeUndefined();
    }
  });
});
