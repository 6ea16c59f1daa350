import { isVideo } from "./codecs";
import { ImageDecoder, mediaType } from "./image_decoder";
import { LatestQueue } from "./latest_queue";
import { decodePatch } from "./patch";
import { PixelReader } from "./pixel_reader";
import { KeyframeNeeded, StreamDecoder } from "./stream_decoder";
import type { EncodedPicture, FromWorker, PictureReport, ToWorker } from "./worker_messages";
import { xxh32 } from "./xxh32";

/** Decodes pictures and draws them, off the page's thread. Entry of the worker. */
const images = new ImageDecoder();
/** Of the views whose video came last: the one that is shown, and one that is about to be. */
const streams = new Map<number, StreamDecoder>();
const kMostStreams = 2;
let reader: PixelReader | undefined;
let canvas: OffscreenCanvas | undefined;
let context: OffscreenCanvasRenderingContext2D | null = null;
let shown: EncodedPicture | undefined;

const now = (): number => performance.timeOrigin + performance.now();
const tell = (message: FromWorker): void => self.postMessage(message);

function report(
  kind: PictureReport["kind"],
  picture: EncodedPicture,
  decodeMs: number,
  more: Partial<Pick<PictureReport, "reason" | "exact" | "keyframeNeeded">> = {},
): void {
  const { id, view, receivedAt } = picture;
  const queue = pictures.waiting + (streams.get(view)?.waiting ?? 0);
  const { reason = "", exact, keyframeNeeded = false } = more;
  const about = { id, receivedAt, doneAt: now(), decodeMs, queue };
  tell({ kind: "report", report: { kind, ...about, reason, exact, keyframeNeeded } });
}

/** Setting a canvas's size clears it, so it is set only where it differs. */
function draw(decoded: ImageBitmap | VideoFrame, { width, height }: EncodedPicture): void {
  if (!canvas || !context) return;
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  context.globalCompositeOperation = "copy";
  context.imageSmoothingEnabled = false;
  context.drawImage(decoded, 0, 0, width, height, 0, 0, width, height);
}

function isExact(picture: EncodedPicture, decoded: ImageBitmap | VideoFrame): boolean | undefined {
  if (!picture.lossless || picture.pixelsXxh32 === 0 || "displayWidth" in decoded) {
    return undefined;
  }
  reader ??= new PixelReader();
  const pixels = reader.read(decoded);
  return pixels && xxh32(pixels) === picture.pixelsXxh32;
}

const isOlder = ({ id }: EncodedPicture): boolean => shown !== undefined && shown.id > id;

function streamOf(view: number): StreamDecoder {
  let stream = streams.get(view);
  if (!stream) {
    stream = new StreamDecoder();
    streams.set(view, stream);
    for (const [old, other] of streams) {
      if (streams.size <= kMostStreams) break;
      streams.delete(old);
      other.close();
    }
  }
  return stream;
}

async function show(picture: EncodedPicture): Promise<void> {
  const begun = now();
  try {
    const decoder = isVideo(picture.codec) ? streamOf(picture.view) : images;
    const decoded = await decoder.decode(picture);
    const decodeMs = now() - begun;
    if (isOlder(picture)) {
      decoded.close();
      report("dropped", picture, decodeMs);
      return;
    }
    draw(decoded, picture);
    shown = picture;
    const exact = isExact(picture, decoded);
    decoded.close();
    report("drawn", picture, decodeMs, { exact });
  } catch (error) {
    const keyframeNeeded = isVideo(picture.codec);
    const reason = error instanceof KeyframeNeeded ? error.message : String(error);
    report("failed", picture, now() - begun, { reason, keyframeNeeded });
  }
}

const pictures = new LatestQueue<EncodedPicture>(show, (picture) => report("dropped", picture, 0));

/** The picture on the screen as it came; of a video as a file of its pixels. */
async function snapshot(): Promise<Blob | undefined> {
  if (!shown) return undefined;
  const type = mediaType(shown.codec);
  return type ? new Blob([shown.payload], { type }) : canvas?.convertToBlob({ type: "image/png" });
}

self.onmessage = (event: MessageEvent<ToWorker>) => {
  const message = event.data;
  if (message.kind === "canvas") {
    canvas = message.canvas;
    context = canvas.getContext("2d", { colorSpace: "srgb" });
  } else if (message.kind === "picture") {
    // Pictures of a video need those before them: none may be left out.
    if (isVideo(message.picture.codec)) void show(message.picture);
    else void pictures.push(message.picture);
  } else if (message.kind === "patch") {
    void decodePatch(message.picture).then((patch) => tell({ kind: "patch", patch }));
  } else {
    void snapshot().then((picture) => tell({ kind: "snapshot", picture }));
  }
};
