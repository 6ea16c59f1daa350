import { create } from "@bufbuild/protobuf";
import { expect, it } from "vitest";
import { Codec, PaceSchema } from "../net/gen/volcast/v1/frame_pb";
import { Role, WelcomeSchema } from "../net/gen/volcast/v1/session_pb";
import { createAppState, type PictureInfo } from "./app_state";
import { followPins, type Pins, paceSentence } from "./pins";

const seat = { id: "v", role: Role.CONTROL, link: undefined };

it("pins are sent when they change, and again where the server knows none", () => {
  const state = createAppState();
  const sent: Pins[] = [];
  const end = followPins(state, (pins) => sent.push(pins));
  state.connection.value = { kind: "open" };
  state.seat.value = seat;
  expect(sent).toEqual([]);
  state.pins.value = { quality: 45 };
  expect(sent).toEqual([{ quality: 45 }]);
  state.connection.value = { kind: "connecting" };
  state.welcome.value = create(WelcomeSchema);
  expect(sent).toHaveLength(1);
  state.connection.value = { kind: "open" };
  expect(sent).toHaveLength(2);
  state.seat.value = { ...seat, id: "another" };
  expect(sent).toHaveLength(3);
  state.pins.value = {};
  expect(sent[3]).toEqual({});
  end();
  state.pins.value = { scale: 0.5 };
  expect(sent).toHaveLength(4);
});

it("what is sent is a sentence", () => {
  const picture = { codec: Codec.JPEG, lossless: false } as PictureInfo;
  const pace = create(PaceSchema, { quality: 60, scale: 0.75, framesPerS: 15 });
  expect(paceSentence(picture, pace)).toBe(
    "JPEG, quality 60, sides × 0.75, drawn faster, less accurate, at most 15 pictures/s",
  );
  const best = create(PaceSchema, { quality: 90, scale: 1, fullAccuracy: true });
  expect(paceSentence({ ...picture, lossless: true }, best)).toBe(
    "lossless, full size, accuracy as asked, as many as drawn",
  );
});
