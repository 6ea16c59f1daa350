import type { EncodedPicture } from "./worker_messages";

/** Turns one encoded picture into pixels; the caller closes them. Rejects on a bad picture. */
export interface Decoder {
  decode(picture: EncodedPicture): Promise<ImageBitmap | VideoFrame>;
}
