import { createHash } from "node:crypto";
import { inflateSync } from "node:zlib";

/** RGBA8, rows from the top, no padding. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array;
}

function paeth(a: number, b: number, c: number): number {
  const p = a + b - c;
  const pa = Math.abs(p - a);
  const pb = Math.abs(p - b);
  const pc = Math.abs(p - c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/** Undoes PNG's row filters in place (PNG specification, section 9). */
function unfilter(raw: Uint8Array, rows: number, rowBytes: number, pixelBytes: number): void {
  for (let y = 0; y < rows; y += 1) {
    const at = y * (rowBytes + 1);
    const filter = raw[at] ?? 0;
    if (filter === 0) continue;
    for (let i = 0; i < rowBytes; i += 1) {
      const here = at + 1 + i;
      const left = i >= pixelBytes ? (raw[here - pixelBytes] ?? 0) : 0;
      const up = y > 0 ? (raw[here - rowBytes - 1] ?? 0) : 0;
      const corner = y > 0 && i >= pixelBytes ? (raw[here - rowBytes - 1 - pixelBytes] ?? 0) : 0;
      let guess = 0; // No list of all five: this runs for every byte.
      if (filter === 1) guess = left;
      else if (filter === 2) guess = up;
      else if (filter === 3) guess = (left + up) >> 1;
      else if (filter === 4) guess = paeth(left, up, corner);
      raw[here] = (raw[here] ?? 0) + guess;
    }
  }
}

/** An 8-bit RGB or RGBA PNG without interlacing; independent of any browser's decoder. */
export function decodePng(file: Uint8Array): Pixels {
  const bytes = Buffer.from(file);
  let at = 8;
  let width = 0;
  let height = 0;
  let channels = 4;
  const packed: Buffer[] = [];
  while (at < bytes.length) {
    const size = bytes.readUInt32BE(at);
    const name = bytes.toString("latin1", at + 4, at + 8);
    const body = bytes.subarray(at + 8, at + 8 + size);
    if (name === "IHDR") {
      width = body.readUInt32BE(0);
      height = body.readUInt32BE(4);
      channels = body[9] === 2 ? 3 : 4;
      if (body[8] !== 8 || body[12] !== 0 || (body[9] !== 2 && body[9] !== 6)) {
        throw new Error(`PNG of depth ${body[8]}, colour type ${body[9]}, interlace ${body[12]}`);
      }
    } else if (name === "IDAT") packed.push(body);
    at += 12 + size;
  }
  const raw = inflateSync(Buffer.concat(packed));
  const rowBytes = width * channels;
  unfilter(raw, height, rowBytes, channels);
  const data = new Uint8Array(width * height * 4).fill(255);
  for (let y = 0; y < height; y += 1) {
    const from = y * (rowBytes + 1) + 1;
    if (channels === 4) data.set(raw.subarray(from, from + rowBytes), y * rowBytes);
    else {
      for (let x = 0; x < width; x += 1) {
        for (let k = 0; k < 3; k += 1) {
          data[4 * (y * width + x) + k] = raw[from + 3 * x + k] ?? 0;
        }
      }
    }
  }
  return { width, height, data };
}

export function hashOf(pixels: Pixels): string {
  return createHash("sha256").update(pixels.data).digest("hex");
}

/** How many different colours there are, counted up to `most`. */
export function countColours(pixels: Pixels, most: number): number {
  const seen = new Set<number>();
  for (let i = 0; i < pixels.data.length && seen.size < most; i += 4) {
    const { [i]: r = 0, [i + 1]: g = 0, [i + 2]: b = 0 } = pixels.data;
    seen.add((r << 16) | (g << 8) | b);
  }
  return seen.size;
}

/** The largest difference of a colour component, and how many pixels differ at all. */
export function difference(a: Pixels, b: Pixels): { largest: number; pixels: number } {
  if (a.width !== b.width || a.height !== b.height) {
    throw new Error(`${a.width}x${a.height} against ${b.width}x${b.height}`);
  }
  let largest = 0;
  let pixels = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    let here = 0;
    for (let k = 0; k < 3; k += 1) {
      here = Math.max(here, Math.abs((a.data[i + k] ?? 0) - (b.data[i + k] ?? 0)));
    }
    largest = Math.max(largest, here);
    pixels += here > 0 ? 1 : 0;
  }
  return { largest, pixels };
}
