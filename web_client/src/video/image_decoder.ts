import { Codec } from "../net/gen/volcast/v1/frame_pb";
import type { Decoder } from "./decoder";
import type { EncodedPicture } from "./worker_messages";

/** Of a picture that is a file by itself; undefined for pictures of a video. */
export function mediaType(codec: Codec): string | undefined {
  switch (codec) {
    case Codec.JPEG:
      return "image/jpeg";
    case Codec.PNG:
      return "image/png";
    case Codec.WEBP:
      return "image/webp";
    default:
      return undefined;
  }
}

/** JPEG, PNG and WebP by the browser's own decoders; no step that would change a colour. */
export class ImageDecoder implements Decoder {
  async decode({ payload, codec }: EncodedPicture): Promise<ImageBitmap> {
    const type = mediaType(codec);
    if (!type) throw new Error(`codec ${codec} is not known`);
    return createImageBitmap(new Blob([payload], { type }), {
      colorSpaceConversion: "none",
      premultiplyAlpha: "none",
      imageOrientation: "from-image",
    });
  }
}
