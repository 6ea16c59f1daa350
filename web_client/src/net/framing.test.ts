import { readFileSync } from "node:fs";
import { fromBinary, fromJson, type JsonValue, toBinary, toJson } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { decodeFrame, encodePrefix, FramingError, isFrame } from "./framing";
import { FrameHeaderSchema } from "./gen/volcast/v1/frame_pb";
import { ClientMessageSchema, ServerMessageSchema } from "./gen/volcast/v1/session_pb";

interface Vector {
  readonly name: string;
  readonly kind: "client" | "server" | "frame" | "invalid_frame";
  readonly hex: string;
  readonly json: { readonly [key: string]: JsonValue };
}

const file = new URL("../../../protocol/vectors/vectors.json", import.meta.url);
const vectors = JSON.parse(readFileSync(file, "utf8")) as Vector[];
const of = (kind: Vector["kind"]): Vector[] => vectors.filter((v) => v.kind === kind);
const bytesOf = (hex: string): Uint8Array<ArrayBuffer> =>
  Uint8Array.from(hex.match(/../g) ?? [], (pair) => Number.parseInt(pair, 16));
const hexOf = (bytes: Uint8Array): string => Buffer.from(bytes).toString("hex");

describe("protocol vectors", () => {
  it("cover every kind", () => {
    for (const kind of ["client", "server", "frame", "invalid_frame"] as const) {
      expect(of(kind).length).toBeGreaterThan(3);
    }
  });

  it.each(of("client"))("$name: bytes and JSON mean the same", ({ hex, json }) => {
    const message = fromBinary(ClientMessageSchema, bytesOf(hex));
    expect(toJson(ClientMessageSchema, message)).toEqual(json);
    expect(hexOf(toBinary(ClientMessageSchema, fromJson(ClientMessageSchema, json)))).toBe(hex);
  });

  it.each(of("server"))("$name: bytes and JSON mean the same", ({ hex, json }) => {
    const message = fromBinary(ServerMessageSchema, bytesOf(hex));
    expect(toJson(ServerMessageSchema, message)).toEqual(json);
    expect(isFrame(bytesOf(hex))).toBe(false);
    expect(hexOf(toBinary(ServerMessageSchema, fromJson(ServerMessageSchema, json)))).toBe(hex);
  });

  it.each(of("frame"))("$name: is taken apart", ({ hex, json }) => {
    const message = bytesOf(hex);
    const { prefix, header, payload } = decodeFrame(message);
    expect(isFrame(message)).toBe(true);
    const { header: expected, payload: expectedPayload, ...expectedPrefix } = json;
    expect(prefix).toEqual(expectedPrefix);
    expect(toJson(FrameHeaderSchema, header)).toEqual(expected);
    expect(hexOf(payload)).toBe(expectedPayload);
    expect(hexOf(encodePrefix(prefix))).toBe(hex.slice(0, 32));
  });

  it.each(of("invalid_frame"))("$name: is refused", ({ hex }) => {
    expect(() => decodeFrame(bytesOf(hex))).toThrow(FramingError);
  });
});
