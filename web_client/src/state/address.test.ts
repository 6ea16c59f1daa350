import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { LayerSchema, RayModel, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { bothOf } from "../transfer/apart";
import { type Address, fromBase64Url, readAddress, toBase64Url, writeAddress } from "./address";
import type { ViewDocument } from "./document";
import { mapMessage, sceneMessage } from "./scene_message";

const map = Array.from({ length: 12 }, (_, i) => ({
  value: i / 11,
  colour: { r: Math.sin(i) ** 2, g: Math.cos(i) ** 2, b: 1 / (i + 1) },
  extinction: i / 3,
}));
const orbit = {
  target: [0.1, 0.2, 0.3],
  axis: [0, 0, 1],
  yaw: 0.123456789,
  pitch: -0.5,
  distance: 7.7,
  fovyDegrees: 35,
  orthographic: false,
} as const;
const layer = create(LayerSchema, {
  id: "a",
  dataset: "blunt/fin é.vtu",
  model: RayModel.MIP,
  transferFunction: mapMessage(map),
});
const document: ViewDocument = {
  scene: create(SceneSchema, { layers: [layer] }),
  orbit,
  home: { ...orbit, yaw: 0 },
  edit: { map, density: 2, smooth: 0.5, apart: bothOf(map) },
};

describe("the page's address", () => {
  it("says all that decides the pictures, and is what it was after reading", async () => {
    const address: Address = { places: [{ document }, { link: "AQ-_w" }], linked: false };
    const text = await writeAddress(address);
    const read = await readAddress(text);
    expect(read.linked).toBe(false);
    expect(read.places[1]).toEqual({ link: "AQ-_w" });
    const [place] = read.places;
    if (!place || !("document" in place)) throw new Error("no document");
    const drawn = (d: ViewDocument) => sceneMessage(d.scene, d.orbit, undefined, d.edit);
    expect(drawn(place.document)).toEqual(drawn(document));
    expect(place.document.edit).toEqual({ ...document.edit, second: undefined });
    expect(await writeAddress({ places: [place], linked: true })).toBe(
      await writeAddress({ places: [{ document }], linked: true }),
    );
  });

  it("fits where addresses are passed on", async () => {
    const text = await writeAddress({ places: [{ document }], linked: true });
    expect(text).toMatch(/^#view=z[\w-]+$/);
    expect(text.length).toBeLessThan(2000);
  });

  it("reads nonsense as nothing, place by place", async () => {
    expect(await readAddress("")).toEqual({ places: [], linked: true });
    const { places } = await readAddress("#view=zAAAA&view=!!&view=&view=q12&other=1&link=");
    expect(places).toEqual([undefined, undefined, undefined, undefined]);
  });

  it("gives up on a few bytes that unpack to many", async () => {
    const zeros = new Blob([new Uint8Array(8 * 1024 * 1024)]).stream();
    const dense = zeros.pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = new Uint8Array(await new Response(dense).arrayBuffer());
    expect(bytes.length).toBeLessThan(100_000);
    expect((await readAddress(`#view=z${toBase64Url(bytes)}`)).places).toEqual([undefined]);
  });

  it("spells bytes as addresses may have them", () => {
    const bytes = Uint8Array.from({ length: 256 }, (_, i) => i);
    expect(toBase64Url(bytes)).toMatch(/^[\w-]+$/);
    expect(fromBase64Url(toBase64Url(bytes))).toEqual(bytes);
    expect(() => fromBase64Url("*")).toThrow();
  });
});
