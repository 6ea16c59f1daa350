import { Codec } from "../net/gen/volcast/v1/frame_pb";

export const isVideo = (codec: Codec): boolean => codec === Codec.VP9 || codec === Codec.H264;

/** What this browser may be able to show; video is tried with a colour patch before it is used. */
export function codecsHere(): Codec[] {
  const stills = [Codec.JPEG, Codec.PNG, Codec.WEBP];
  // Only pages of secure origins have WebCodecs.
  return typeof VideoDecoder === "undefined" ? stills : [...stills, Codec.VP9, Codec.H264];
}

const kNalSps = 7;

/**
 * The codec string of an Annex B keyframe, from its sequence parameter set: profile, constraints and
 * level (ITU-T H.264, section 7.3.2.1.1). Undefined where there is none.
 */
export function h264Name(keyframe: Uint8Array): string | undefined {
  for (let at = 0; at + 6 < keyframe.length; at += 1) {
    const isStart = keyframe[at] === 0 && keyframe[at + 1] === 0 && keyframe[at + 2] === 1;
    if (!isStart || ((keyframe[at + 3] ?? 0) & 31) !== kNalSps) continue;
    const bytes = keyframe.subarray(at + 4, at + 7);
    return `avc1.${Array.from(bytes, (b) => b.toString(16).padStart(2, "0")).join("")}`;
  }
  return undefined;
}

/** Profile 1, level 6.2, 8 bits, 4:4:4, BT.709, sRGB's curve, full range. */
export const kVp9Name = "vp09.01.62.08.03.01.13.01.01";
