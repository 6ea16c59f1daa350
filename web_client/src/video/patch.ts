import { isVideo } from "./codecs";
import { ImageDecoder } from "./image_decoder";
import { StreamDecoder } from "./stream_decoder";
import type { DecodedPatch, EncodedPicture } from "./worker_messages";

/** A colour patch is so many squares of one size. */
const kColumns = 4;
const kRows = 2;

/** What this browser's decoder makes of a colour patch, at the middle of each square. */
export async function decodePatch(picture: EncodedPicture): Promise<DecodedPatch> {
  const { codec, width, height } = picture;
  const stream = isVideo(codec) ? new StreamDecoder() : undefined;
  try {
    const decoded = await (stream ?? new ImageDecoder()).decode(picture);
    const context = new OffscreenCanvas(width, height).getContext("2d", { colorSpace: "srgb" });
    if (!context) throw new Error("this browser gives no canvas");
    context.drawImage(decoded, 0, 0, width, height, 0, 0, width, height);
    decoded.close();
    const rgb = new Uint8Array(3 * kColumns * kRows);
    for (let square = 0; square < kColumns * kRows; square += 1) {
      const x = ((square % kColumns) + 0.5) * (width / kColumns);
      const y = (Math.floor(square / kColumns) + 0.5) * (height / kRows);
      const { data } = context.getImageData(Math.floor(x), Math.floor(y), 1, 1);
      rgb.set(data.subarray(0, 3), 3 * square);
    }
    return { codec, rgb, error: "" };
  } catch (error) {
    return { codec, rgb: new Uint8Array(0), error: String(error) };
  } finally {
    stream?.close();
  }
}
