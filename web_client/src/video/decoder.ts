import type { Codec } from "../net/gen/volcast/v1/frame_pb";

/** Turns one encoded picture into pixels; the caller closes the bitmap. Rejects on a bad picture. */
export interface Decoder {
  decode(payload: Uint8Array<ArrayBuffer>, codec: Codec): Promise<ImageBitmap>;
}
