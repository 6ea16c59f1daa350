const kPrime1 = 2654435761;
const kPrime2 = 2246822519;
const kPrime3 = 3266489917;
const kPrime4 = 668265263;
const kPrime5 = 374761393;

const rotated = (x: number, bits: number): number => (x << bits) | (x >>> (32 - bits));
const round = (sum: number, word: number): number =>
  Math.imul(rotated((sum + Math.imul(word, kPrime2)) | 0, 13), kPrime1);

/** XXH32 with seed 0, by the xxHash specification (doc/xxhash_spec.md of the reference library). */
export function xxh32(bytes: Uint8Array): number {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const size = bytes.length;
  let at = 0;
  let hash = kPrime5 | 0;
  if (size >= 16) {
    let a = (kPrime1 + kPrime2) | 0;
    let b = kPrime2 | 0;
    let c = 0;
    let d = -kPrime1 | 0;
    for (; at + 16 <= size; at += 16) {
      a = round(a, view.getUint32(at, true));
      b = round(b, view.getUint32(at + 4, true));
      c = round(c, view.getUint32(at + 8, true));
      d = round(d, view.getUint32(at + 12, true));
    }
    hash = (rotated(a, 1) + rotated(b, 7) + rotated(c, 12) + rotated(d, 18)) | 0;
  }
  hash = (hash + size) | 0;
  for (; at + 4 <= size; at += 4) {
    const word = view.getUint32(at, true);
    hash = Math.imul(rotated((hash + Math.imul(word, kPrime3)) | 0, 17), kPrime4);
  }
  for (; at < size; at += 1) {
    hash = Math.imul(rotated((hash + Math.imul(bytes[at] ?? 0, kPrime5)) | 0, 11), kPrime1);
  }
  hash = Math.imul(hash ^ (hash >>> 15), kPrime2);
  hash = Math.imul(hash ^ (hash >>> 13), kPrime3);
  return (hash ^ (hash >>> 16)) >>> 0;
}
