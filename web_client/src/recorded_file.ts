import { zipSync } from "fflate";

const kFramesPerSecond = 30;
/** Enough for pictures with fine detail; the lossless ones are the archive's. */
const kBitsPerPixel = 0.25;
const kTypes = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

/** The lossless pictures in an archive, in order by their names. */
export async function png(pictures: readonly Blob[]): Promise<Blob> {
  const files = await Promise.all(
    pictures.map(async (picture, i) => {
      const name = `turn-${String(i).padStart(3, "0")}.png`;
      return [name, new Uint8Array(await picture.arrayBuffer())] as const;
    }),
  );
  const archive = zipSync(Object.fromEntries(files), { level: 0 }); // PNG is compressed already.
  return new Blob([archive as Uint8Array<ArrayBuffer>], { type: "application/zip" });
}

const elapsed = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));

/** The pictures at 30 a second, as the browser's recorder encodes them while they are played. */
export async function webm(pictures: readonly Blob[], signal: AbortSignal): Promise<Blob> {
  const first = pictures[0];
  if (!first) throw new Error("there is no picture");
  const { width, height } = await createImageBitmap(first);
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  const stream = canvas.captureStream(0);
  const [track] = stream.getVideoTracks() as CanvasCaptureMediaStreamTrack[];
  if (!context || !track) throw new Error("the browser records no canvas");
  const recorder = new MediaRecorder(stream, {
    mimeType: kTypes.find((type) => MediaRecorder.isTypeSupported(type)) ?? "",
    videoBitsPerSecond: Math.round(width * height * kFramesPerSecond * kBitsPerPixel),
  });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const ended = new Promise((resolve, reject) => {
    recorder.onstop = resolve;
    recorder.onerror = () => reject(new Error("the browser's recorder failed"));
  });
  let started = false;
  recorder.onstart = () => {
    started = true;
  };
  recorder.start();
  for (const picture of pictures) {
    const bitmap = await createImageBitmap(picture);
    do {
      signal.throwIfAborted();
      context.drawImage(bitmap, 0, 0, width, height);
      track.requestFrame();
      await elapsed(1000 / kFramesPerSecond);
    } while (!started); // What is played before its encoder runs would be lost.
    bitmap.close();
  }
  recorder.stop();
  await ended;
  track.stop();
  return new Blob(parts, { type: "video/webm" });
}
