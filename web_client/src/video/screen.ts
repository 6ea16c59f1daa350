import type {
  DecodedPatch,
  EncodedPicture,
  FromWorker,
  PictureReport,
  ToWorker,
} from "./worker_messages";

/** The canvas and the worker that draws into it. */
export interface Screen {
  /** Hands a picture over; its payload's buffer is gone afterwards. */
  show(picture: EncodedPicture): void;
  /** Decodes a colour patch without showing it; its payload's buffer is gone afterwards. */
  tryPatch(picture: EncodedPicture): void;
  /** The picture on the screen as it came, undefined before the first. */
  snapshot(): Promise<Blob | undefined>;
  /** Ends the worker. */
  close(): void;
}

/** `reported` hears of every picture once: drawn, dropped or failed; `tried` of every patch. */
export function openScreen(
  canvas: HTMLCanvasElement,
  reported: (report: PictureReport) => void,
  tried: (patch: DecodedPatch) => void,
  broken: (reason: string) => void,
): Screen {
  const worker = new Worker(new URL("./video_worker.ts", import.meta.url), { type: "module" });
  const asked: ((picture: Blob | undefined) => void)[] = [];
  const tell = (message: ToWorker, transfer: Transferable[]): void =>
    worker.postMessage(message, transfer);

  worker.onmessage = (event: MessageEvent<FromWorker>) => {
    const message = event.data;
    if (message.kind === "report") reported(message.report);
    else if (message.kind === "patch") tried(message.patch);
    else asked.shift()?.(message.picture);
  };
  worker.onerror = (event) => broken(event.message || "the decoding worker did not start");
  const offscreen = canvas.transferControlToOffscreen();
  tell({ kind: "canvas", canvas: offscreen }, [offscreen]);

  return {
    show: (picture) => tell({ kind: "picture", picture }, [picture.payload.buffer]),
    tryPatch: (picture) => tell({ kind: "patch", picture }, [picture.payload.buffer]),
    snapshot: () =>
      new Promise((resolve) => {
        asked.push(resolve);
        tell({ kind: "snapshot" }, []);
      }),
    close: () => worker.terminate(),
  };
}
