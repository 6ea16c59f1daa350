import { create } from "@bufbuild/protobuf";
import { beforeAll, describe, expect, it } from "vitest";
import { currentDocument, restoreDocument } from "../state/actions";
import { createAppState } from "../state/app_state";
import type { ViewDocument } from "../state/document";
import { ErrorCode, ErrorSchema } from "./gen/volcast/v1/error_pb";
import { type Scene, SceneSchema } from "./gen/volcast/v1/scene_pb";
import {
  PeopleSchema,
  Role,
  SceneChangedSchema,
  ViewOpenedSchema,
  WelcomeSchema,
} from "./gen/volcast/v1/session_pb";
import { type ViewBeginning, ViewConversation } from "./view_conversation";
import type { Body } from "./wire";

const kMe = 7;
const orbit = {
  target: [0, 0, 0],
  axis: [0, 0, 1],
  yaw: 0,
  pitch: 0,
  distance: 1,
  fovyDegrees: 35,
  orthographic: false,
} as const;
const scene = create(SceneSchema, {
  camera: { eye: { x: 1 }, up: { z: 1 }, fovyDegrees: 35 },
  layers: [{ id: "a", dataset: "d" }],
});
const document: ViewDocument = { scene, orbit, home: orbit, edit: { map: [], density: 1 } };

/** A conversation whose messages are kept, and what it says to whoever shows the view. */
function setUp(beginning: ViewBeginning = {}, shown: ViewDocument | undefined = document) {
  const state = createAppState();
  state.viewport.value = { width: 8, height: 6 };
  state.welcome.value = create(WelcomeSchema, { person: kMe });
  if (shown) restoreDocument(state, shown);
  const sent: Body[] = [];
  const said: string[] = [];
  let last = beginning.number ?? 0;
  const wire = {
    greeted: true,
    send(body: Body) {
      sent.push(body);
      return wire.greeted;
    },
    newNumber() {
      last += 1;
      return last;
    },
  };
  const say = (what: string) => (): void => void said.push(what);
  const view = new ViewConversation(
    wire,
    state,
    {
      frame: say("frame"),
      restarted: say("restarted"),
      opened: say("opened"),
      joined: say("joined"),
      restored: say("restored"),
      followed: say("followed"),
      moved: say("moved"),
      thumbnail: say("thumbnail"),
      current: () => currentDocument(state),
    },
    beginning,
  );
  const cases = (): string[] => sent.splice(0).map((body) => body.case ?? "");
  const opened = (number: number, inputSeq: bigint, of: Scene = scene): void =>
    view.opened(
      create(ViewOpenedSchema, { view: number, scene: of, id: "v", role: Role.CONTROL, inputSeq }),
    );
  const steering = (number: number, person: number): void =>
    view.listed(
      create(PeopleSchema, {
        view: number,
        people: [
          { id: kMe, name: "Me", role: Role.CONTROL, steers: person === kMe },
          { id: 8, name: "Ann", role: Role.CONTROL, steers: person === 8 },
        ],
      }),
    );
  return { view, state, wire, sent, said, cases, opened, steering };
}

beforeAll(() => {
  globalThis.requestAnimationFrame ??= (run) => setTimeout(run, 16) as unknown as number;
});

describe("a view's conversation", () => {
  it("opens what is shown, and again after a loss that the server did not outlive", () => {
    const { view, cases, opened, said } = setUp();
    view.welcomed(false);
    expect(cases()).toEqual(["openView"]);
    opened(1, 1n);
    view.lost();
    view.welcomed(false);
    expect(cases()).toEqual(["openView"]);
    expect(view.owns(2)).toBe(true);
    expect(view.owns(1)).toBe(false);
    expect(said).toEqual([]);
  });

  it("goes on with a view that the server kept: its size is told, nothing else", () => {
    const { view, sent, said, opened, steering } = setUp({ number: 3, inputSeq: 5n });
    view.welcomed(true);
    opened(3, 5n);
    expect(sent).toEqual([]);
    steering(3, kMe);
    expect(said).toEqual(["restarted"]);
    expect(sent).toHaveLength(1);
    expect(sent[0]).toMatchObject({ case: "update", value: { view: 3, inputSeq: 6n } });
    expect(sent[0]?.value).toMatchObject({ scene: undefined, camera: undefined });
  });

  it("sends what the server missed, where nobody else steered meanwhile", () => {
    const { view, wire, sent, said, opened, steering } = setUp({ number: 3, inputSeq: 5n });
    wire.greeted = false;
    view.lost();
    view.mark("camera");
    wire.greeted = true;
    sent.length = 0;
    view.welcomed(true);
    opened(3, 5n);
    steering(3, kMe);
    expect(said).toEqual(["restarted"]);
    expect(sent[0]).toMatchObject({ case: "update", value: { view: 3, inputSeq: 6n } });
    expect(sent[0]?.value).toHaveProperty("camera.eye");
  });

  it("takes what others did meanwhile, and sends nothing of its own", () => {
    const { view, sent, said, opened, steering } = setUp({ number: 3, inputSeq: 5n });
    view.mark("camera");
    sent.length = 0;
    view.lost();
    view.welcomed(true);
    opened(3, 9n);
    steering(3, 8);
    expect(said).toEqual(["restarted", "followed"]);
    const changes = sent.filter((b) => b.case === "update" && (b.value.scene || b.value.camera));
    expect(changes).toEqual([]);
  });

  it("opens a view again that has ended meanwhile", () => {
    const { view, cases } = setUp({ number: 3, inputSeq: 5n });
    view.welcomed(true);
    view.error(create(ErrorSchema, { code: ErrorCode.NOT_FOUND, view: 3, message: "has ended" }));
    expect(cases()).toEqual(["openView"]);
  });

  it("joins by its link again, and goes on with a copy where that is no good any more", () => {
    const { view, sent, said, opened, state } = setUp();
    view.join("signed");
    opened(1, 4n);
    expect(said).toEqual(["joined"]);
    view.lost();
    sent.length = 0;
    view.welcomed(false);
    expect(sent[0]).toMatchObject({ case: "openView", value: { link: "signed" } });
    sent.length = 0;
    view.error(create(ErrorSchema, { view: 2, field: "link", message: "the link has expired" }));
    expect(sent.map((b) => b.case)).toEqual(["closeView", "openView"]);
    expect(sent[1]?.value).toMatchObject({ scene: { layers: [{ dataset: "d" }] } });
    expect(state.notices.value[0]?.text).toMatch(/copy/);
    expect(state.seat.value).toBeUndefined();
  });

  it("changes nothing of a view that somebody else steers", () => {
    const { view, cases, opened, steering, state } = setUp();
    view.welcomed(false);
    opened(1, 1n);
    steering(1, 8);
    cases();
    view.mark("scene");
    view.mark("camera");
    expect(cases()).toEqual([]);
    view.open({ dataset: "e", document: undefined, shown: false });
    expect(cases()).toEqual([]);
    expect(state.notices.value[0]?.text).toMatch(/^Ann steers this view/);
    view.mark("viewport");
    expect(cases()).toEqual(["update"]);
  });

  it("counts on from the inputs of others", () => {
    const { view, sent, opened, steering, said, state } = setUp();
    view.welcomed(false);
    opened(1, 1n);
    steering(1, 8);
    view.changed(create(SceneChangedSchema, { view: 1, inputSeq: 40n, camera: {} }));
    expect(said).toContain("moved");
    expect(state.newestInput.value).toBe(40n);
    sent.length = 0;
    steering(1, kMe);
    expect(sent[0]?.value).toMatchObject({ view: 1, inputSeq: 41n });
  });

  it("takes others along to other data, in the view that they are in", () => {
    const { view, sent, opened, steering } = setUp();
    view.welcomed(false);
    opened(1, 1n);
    steering(1, kMe);
    sent.length = 0;
    view.open({ dataset: "e", document: undefined, shown: false });
    const other = create(SceneSchema, {
      camera: { eye: { x: 1 }, up: { z: 1 }, fovyDegrees: 35 },
      layers: [{ id: "a", dataset: "e" }],
    });
    opened(2, 2n, other);
    expect(sent.map((b) => b.case)).toEqual(["openView", "closeView", "update"]);
    expect(sent[1]?.value).toMatchObject({ view: 2 });
    expect(sent[2]?.value).toMatchObject({ view: 1 });
    expect(view.number).toBe(1);
  });

  it("leaves others where they are", () => {
    const { view, sent, opened, steering, said, state } = setUp();
    view.join("signed");
    opened(1, 4n);
    steering(1, 8);
    sent.length = 0;
    view.leave(document);
    opened(2, 5n);
    expect(sent.map((b) => b.case)).toEqual(["openView", "closeView"]);
    expect(sent[1]?.value).toMatchObject({ view: 1 });
    expect(said).toEqual(["joined", "restored"]);
    expect(state.seat.value?.link).toBeUndefined();
    expect(state.people.value).toEqual([]);
  });

  it("closes what it has open", () => {
    const { view, sent, opened } = setUp();
    view.welcomed(false);
    opened(1, 1n);
    sent.length = 0;
    view.close();
    expect(sent).toEqual([{ case: "closeView", value: { view: 1 } }]);
    expect(view.number).toBeUndefined();
  });
});
