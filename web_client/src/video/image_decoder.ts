import { Codec } from "../net/gen/volcast/v1/frame_pb";
import type { Decoder } from "./decoder";

export function mediaType(codec: Codec): string {
  return codec === Codec.PNG ? "image/png" : "image/jpeg";
}

/** JPEG and PNG by the browser's own decoders; no step that would change a colour. */
export class ImageDecoder implements Decoder {
  decode(payload: Uint8Array<ArrayBuffer>, codec: Codec): Promise<ImageBitmap> {
    const picture = new Blob([payload], { type: mediaType(codec) });
    return createImageBitmap(picture, {
      colorSpaceConversion: "none",
      premultiplyAlpha: "none",
      imageOrientation: "from-image",
    });
  }
}
