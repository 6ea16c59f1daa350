import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { Role } from "../net/gen/volcast/v1/session_pb";
import { type KeptPage, readPage, writePage } from "./keeper";

const orbit = {
  target: [0, 0, 0],
  axis: [0, 0, 1],
  yaw: 0,
  pitch: 0,
  distance: 1,
  fovyDegrees: 35,
  orthographic: false,
} as const;

const page: KeptPage = {
  fragment: "#view=zAQ",
  linked: false,
  views: [
    {
      document: {
        scene: create(SceneSchema, { layers: [{ id: "a", dataset: "d" }] }),
        orbit,
        home: orbit,
        edit: { map: [], density: 1, smooth: undefined, apart: undefined, second: undefined },
      },
      link: undefined,
      links: [{ role: Role.WATCH, link: "AQ-_", expires: 1_800_000_000 }],
      number: 3,
      inputSeq: 9007199254740993n,
    },
    { document: undefined, link: "AQ", links: [], number: undefined, inputSeq: 0n },
  ],
  resume: { token: "secret", lastNumber: 4 },
};

describe("what a page leaves behind", () => {
  it("is read as it was written", () => {
    expect(readPage(writePage(page))).toEqual(page);
    const ended = { ...page, resume: undefined };
    expect(readPage(writePage(ended))).toEqual(ended);
  });

  it("is nothing where it is not ours, and what of it can be read otherwise", () => {
    expect(readPage(null)).toBeUndefined();
    expect(readPage("{")).toBeUndefined();
    expect(readPage('{"version":1}')).toBeUndefined();
    expect(readPage(writePage(page).replace('"version":1', '"version":2'))).toBeUndefined();
    const odd = JSON.stringify({ version: 1, fragment: "", views: [{ links: [{}], number: "3" }] });
    expect(readPage(odd)?.views).toEqual([
      { document: undefined, link: undefined, links: [], number: undefined, inputSeq: 0n },
    ]);
  });
});
