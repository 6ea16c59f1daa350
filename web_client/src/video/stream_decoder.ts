import { Codec } from "../net/gen/volcast/v1/frame_pb";
import { h264Name, kVp9Name } from "./codecs";
import type { Decoder } from "./decoder";
import type { EncodedPicture } from "./worker_messages";

interface Waiting {
  resolve(frame: VideoFrame): void;
  reject(reason: Error): void;
}

/** A picture that only a keyframe could replace. */
export class KeyframeNeeded extends Error {}

/**
 * One VP9 or H.264 stream by WebCodecs, pictures in the order of their ids. After a picture that
 * failed all are rejected with KeyframeNeeded until a keyframe comes.
 */
export class StreamDecoder implements Decoder {
  #decoder: VideoDecoder | undefined;
  #name = "";
  readonly #waiting = new Map<number, Waiting>();

  /** Pictures that were given and are not decoded. */
  get waiting(): number {
    return this.#waiting.size;
  }

  decode(picture: EncodedPicture): Promise<VideoFrame> {
    return new Promise((resolve, reject) => {
      try {
        const decoder = this.#ready(picture);
        this.#waiting.set(picture.id, { resolve, reject });
        const type = picture.keyframe ? "key" : "delta";
        const { id: timestamp, payload: data } = picture;
        decoder.decode(new EncodedVideoChunk({ type, timestamp, data }));
      } catch (error) {
        if (!(error instanceof KeyframeNeeded)) this.#fail(String(error));
        reject(error);
      }
    });
  }

  close(): void {
    this.#fail("closed");
  }

  #ready(picture: EncodedPicture): VideoDecoder {
    if (!picture.keyframe) {
      if (!this.#decoder) throw new KeyframeNeeded("no keyframe came before this picture");
      return this.#decoder;
    }
    const name = picture.codec === Codec.VP9 ? kVp9Name : h264Name(picture.payload);
    if (!name) throw new Error("a keyframe without parameters");
    if (this.#decoder && name === this.#name) return this.#decoder;
    if (this.#decoder) this.#fail("another codec follows");
    const decoder = new VideoDecoder({
      output: (frame) => {
        const waiting = this.#waiting.get(frame.timestamp);
        this.#waiting.delete(frame.timestamp);
        if (waiting) waiting.resolve(frame);
        else frame.close();
      },
      error: (error) => {
        if (decoder === this.#decoder) this.#fail(error.message);
      },
    });
    decoder.configure({ codec: name, optimizeForLatency: true });
    this.#decoder = decoder;
    this.#name = name;
    return decoder;
  }

  #fail(reason: string): void {
    if (this.#decoder?.state !== "closed") this.#decoder?.close();
    this.#decoder = undefined;
    for (const { reject } of this.#waiting.values()) reject(new KeyframeNeeded(reason));
    this.#waiting.clear();
  }
}
