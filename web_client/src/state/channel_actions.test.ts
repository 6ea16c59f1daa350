import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { DatasetInfoSchema, DatasetKind, DatasetState } from "../net/gen/volcast/v1/session_pb";
import { adoptScene, changeLayer, undo } from "./actions";
import { createAppState } from "./app_state";
import { canDrawTogether, changeChannel, drawTogether, lookOf } from "./channel_actions";
import { fittedTo } from "./models";

const point = (value: number) => ({ value, colour: { r: 1, g: 1, b: 1 }, extinction: 1 });

function opened(names = ["red", "green"]) {
  const state = createAppState();
  const dataset = create(DatasetInfoSchema, {
    id: "channels",
    state: DatasetState.READY,
    kind: DatasetKind.VOLUME,
    boundsMax: { x: 1, y: 1, z: 1 },
    fields: names.map((name, i) => ({ name, min: 0, max: 10 * (i + 1) })),
  });
  state.datasets.value = [dataset];
  const transferFunction = { points: [point(0), point(10)] };
  const layers = [{ id: "l", dataset: dataset.id, field: names[0] ?? "", transferFunction }];
  adoptScene(state, create(SceneSchema, { layers }));
  return state;
}

describe("channels", () => {
  it("are drawn together over their own ranges, and alone again", () => {
    const state = opened();
    expect(canDrawTogether(state)).toBe(true);
    drawTogether(state, true);
    const channels = state.layer.value?.channels ?? [];
    expect(channels.map((c) => c.field)).toEqual(["red", "green"]);
    const look = channels[1] && lookOf(channels[1], state.referenceLength.value);
    expect(look?.first).toBe(0);
    expect(look?.last).toBe(20);
    expect(look?.opacity).toBeCloseTo(0.6, 9);
    drawTogether(state, false);
    expect(state.layer.value?.channels).toEqual([]);
    undo(state);
    expect(state.layer.value?.channels.length).toBe(2);
  });

  it("change one by one, and turn round", () => {
    const state = opened();
    drawTogether(state, true);
    changeChannel(state, 0, { hidden: true });
    changeChannel(state, 1, { first: 8, last: 3, opacity: 0.25 });
    changeChannel(state, 1, { first: 3 });
    const [red, green] = state.layer.value?.channels ?? [];
    expect(red?.hidden).toBe(true);
    const look = green && lookOf(green, state.referenceLength.value);
    expect([look?.first, look?.last]).toEqual([8, 3]);
    expect(look?.opacity).toBeCloseTo(0.25, 9);
  });

  it("are at most four, of volumes with several", () => {
    expect(canDrawTogether(opened(["one"]))).toBe(false);
    const state = opened(["a", "b", "c", "d", "e"]);
    drawTogether(state, true);
    expect(state.layer.value?.channels.length).toBe(4);
  });

  it("are left when a model draws one alone", () => {
    const state = opened();
    drawTogether(state, true);
    const layer = state.layer.value;
    if (!layer) throw new Error("there is no layer");
    expect(fittedTo(layer, RayModel.MIP).channels?.length).toBe(2);
    changeLayer(state, fittedTo(layer, RayModel.ISOSURFACE));
    expect(state.layer.value?.channels).toEqual([]);
    expect(canDrawTogether(state)).toBe(false);
  });
});
