import type { Codec } from "../net/gen/volcast/v1/frame_pb";

/** One encoded picture on its way to the screen. Times: milliseconds since the epoch. */
export interface EncodedPicture {
  /** Grows with every picture that arrives. */
  readonly id: number;
  readonly view: number;
  readonly codec: Codec;
  /** In pixels; what a decoder adds at the right and at the bottom is not shown. */
  readonly width: number;
  readonly height: number;
  readonly keyframe: boolean;
  readonly lossless: boolean;
  /** XXH32 of the pixels of a lossless picture; 0: not known. */
  readonly pixelsXxh32: number;
  readonly payload: Uint8Array<ArrayBuffer>;
  readonly receivedAt: number;
}

export type ToWorker =
  | { readonly kind: "canvas"; readonly canvas: OffscreenCanvas }
  | { readonly kind: "picture"; readonly picture: EncodedPicture }
  | { readonly kind: "patch"; readonly picture: EncodedPicture }
  | { readonly kind: "snapshot" };

/** What became of a picture. `dropped`: a newer one came before this one was decoded. */
export interface PictureReport {
  readonly kind: "drawn" | "dropped" | "failed";
  readonly id: number;
  readonly receivedAt: number;
  readonly doneAt: number;
  readonly decodeMs: number;
  /** Pictures that waited in the worker when this one was done. */
  readonly queue: number;
  readonly reason: string;
  /** Of a lossless picture: its pixels are those that the server hashed. */
  readonly exact: boolean | undefined;
  /** Nothing more of the stream can be shown before a keyframe. */
  readonly keyframeNeeded: boolean;
}

/** What a decoder made of a colour patch; `error` says why it made nothing. */
export interface DecodedPatch {
  readonly codec: Codec;
  readonly rgb: Uint8Array<ArrayBuffer>;
  readonly error: string;
}

export type FromWorker =
  | { readonly kind: "report"; readonly report: PictureReport }
  | { readonly kind: "patch"; readonly patch: DecodedPatch }
  | { readonly kind: "snapshot"; readonly picture: Blob | undefined };
