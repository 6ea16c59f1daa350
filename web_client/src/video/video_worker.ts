import { ImageDecoder, mediaType } from "./image_decoder";
import { LatestQueue } from "./latest_queue";
import type { EncodedPicture, FromWorker, PictureReport, ToWorker } from "./worker_messages";

/** Decodes pictures and draws them, off the page's thread. Entry of the worker. */
const decoder = new ImageDecoder();
let canvas: OffscreenCanvas | undefined;
let context: OffscreenCanvasRenderingContext2D | null = null;
let shown: EncodedPicture | undefined;

const now = (): number => performance.timeOrigin + performance.now();
const tell = (message: FromWorker): void => self.postMessage(message);

function report(
  kind: PictureReport["kind"],
  picture: EncodedPicture,
  decodeMs: number,
  reason = "",
): void {
  const { view, sequence, receivedAt } = picture;
  const queue = pictures.waiting;
  tell({
    kind: "report",
    report: { kind, view, sequence, receivedAt, doneAt: now(), decodeMs, queue, reason },
  });
}

/** Setting a canvas's size clears it, so it is set only where it differs. */
function draw(bitmap: ImageBitmap): void {
  if (!canvas || !context) return;
  if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
    canvas.width = bitmap.width;
    canvas.height = bitmap.height;
  }
  context.globalCompositeOperation = "copy";
  context.imageSmoothingEnabled = false;
  context.drawImage(bitmap, 0, 0);
}

async function show(picture: EncodedPicture): Promise<void> {
  const begun = now();
  try {
    const bitmap = await decoder.decode(picture.payload, picture.codec);
    const decodeMs = now() - begun;
    draw(bitmap);
    bitmap.close();
    shown = picture;
    report("drawn", picture, decodeMs);
  } catch (error) {
    report("failed", picture, now() - begun, String(error));
  }
}

const pictures = new LatestQueue<EncodedPicture>(show, (picture) => report("dropped", picture, 0));

self.onmessage = (event: MessageEvent<ToWorker>) => {
  const message = event.data;
  if (message.kind === "canvas") {
    canvas = message.canvas;
    context = canvas.getContext("2d", { colorSpace: "srgb" });
  } else if (message.kind === "picture") {
    void pictures.push(message.picture);
  } else {
    const picture = shown && new Blob([shown.payload], { type: mediaType(shown.codec) });
    tell({ kind: "snapshot", picture });
  }
};
