import { fromBinary, fromJsonString } from "@bufbuild/protobuf";
import { type FrameHeader, FrameHeaderSchema } from "./gen/volcast/v1/frame_pb";

export const kMajor = 1;
export const kMinor = 3;
export const kPrefixBytes = 16;
export const kFrameType = 1;
/** Bit 0 of the prefix's flags: the header is protobuf JSON. */
export const kJsonHeaderFlag = 1;

/** The fixed little-endian part in front of every frame. */
export interface FramePrefix {
  readonly version: number;
  readonly type: number;
  readonly flags: number;
  readonly headerBytes: number;
  readonly view: number;
  readonly sequence: number;
}

/** A frame taken apart; `payload` views the message, nothing is copied. */
export interface Frame {
  readonly prefix: FramePrefix;
  readonly header: FrameHeader;
  readonly payload: Uint8Array<ArrayBuffer>;
}

/** Says what is wrong with a frame. */
export class FramingError extends Error {}

export function encodePrefix(prefix: FramePrefix): Uint8Array {
  const bytes = new DataView(new ArrayBuffer(kPrefixBytes));
  bytes.setUint8(0, prefix.version);
  bytes.setUint8(1, prefix.type);
  bytes.setUint16(2, prefix.flags, true);
  bytes.setUint32(4, prefix.headerBytes, true);
  bytes.setUint32(8, prefix.view, true);
  bytes.setUint32(12, prefix.sequence, true);
  return new Uint8Array(bytes.buffer);
}

/** Throws FramingError: short, another version or type, header longer than the message. */
export function decodePrefix(message: Uint8Array): FramePrefix {
  if (message.length < kPrefixBytes) {
    throw new FramingError(`frame: ${message.length} bytes, a prefix has ${kPrefixBytes}`);
  }
  const bytes = new DataView(message.buffer, message.byteOffset, kPrefixBytes);
  const prefix: FramePrefix = {
    version: bytes.getUint8(0),
    type: bytes.getUint8(1),
    flags: bytes.getUint16(2, true),
    headerBytes: bytes.getUint32(4, true),
    view: bytes.getUint32(8, true),
    sequence: bytes.getUint32(12, true),
  };
  if (prefix.version !== kMajor) {
    throw new FramingError(`frame: version ${prefix.version}, this client reads ${kMajor}`);
  }
  if (prefix.type !== kFrameType) {
    throw new FramingError(`frame: type ${prefix.type}, this client reads ${kFrameType}`);
  }
  const room = message.length - kPrefixBytes;
  if (prefix.headerBytes > room) {
    throw new FramingError(`frame: header of ${prefix.headerBytes} bytes, ${room} follow`);
  }
  return prefix;
}

/** Throws FramingError as decodePrefix does, and for a header that does not parse. */
export function decodeFrame(message: Uint8Array<ArrayBuffer>): Frame {
  const prefix = decodePrefix(message);
  const end = kPrefixBytes + prefix.headerBytes;
  const bytes = message.subarray(kPrefixBytes, end);
  try {
    const header =
      prefix.flags & kJsonHeaderFlag
        ? fromJsonString(FrameHeaderSchema, new TextDecoder().decode(bytes))
        : fromBinary(FrameHeaderSchema, bytes);
    return { prefix, header, payload: message.subarray(end) };
  } catch (cause) {
    throw new FramingError(`frame ${prefix.sequence}: its header does not parse`, { cause });
  }
}

/** A frame begins with its version; no protobuf message can begin with that byte. */
export function isFrame(message: Uint8Array): boolean {
  return message[0] === kMajor;
}
