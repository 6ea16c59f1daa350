import type { Codec } from "../net/gen/volcast/v1/frame_pb";

/** One encoded picture on its way to the screen. Times: milliseconds since the epoch. */
export interface EncodedPicture {
  readonly view: number;
  readonly sequence: number;
  readonly codec: Codec;
  readonly payload: Uint8Array<ArrayBuffer>;
  readonly receivedAt: number;
}

export type ToWorker =
  | { readonly kind: "canvas"; readonly canvas: OffscreenCanvas }
  | { readonly kind: "picture"; readonly picture: EncodedPicture }
  | { readonly kind: "snapshot" };

/** What became of a picture. `dropped`: a newer one came before this one was decoded. */
export interface PictureReport {
  readonly kind: "drawn" | "dropped" | "failed";
  readonly view: number;
  readonly sequence: number;
  readonly receivedAt: number;
  readonly doneAt: number;
  readonly decodeMs: number;
  /** Pictures that waited in the worker when this one was done. */
  readonly queue: number;
  readonly reason: string;
}

export type FromWorker =
  | { readonly kind: "report"; readonly report: PictureReport }
  | { readonly kind: "snapshot"; readonly picture: Blob | undefined };
