import { readDocument, type ViewDocument, writeDocument } from "./document";

/** What one view of the page is: its own state, or a link to a view of the server. */
export type Place = { readonly document: ViewDocument } | { readonly link: string };

/** All that the page shows, as the part of its address behind the #. */
export interface Address {
  readonly places: readonly Place[];
  /** Cameras go along with each other. */
  readonly linked: boolean;
}

async function through(
  bytes: Uint8Array<ArrayBuffer>,
  stream: CompressionStream | DecompressionStream,
): Promise<Uint8Array<ArrayBuffer>> {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

/** Base64url without padding (RFC 4648, section 5). */
export function toBase64Url(bytes: Uint8Array): string {
  const text = btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""));
  return text.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** Throws for anything else. */
export function fromBase64Url(text: string): Uint8Array<ArrayBuffer> {
  const bytes = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(bytes, (c) => c.charCodeAt(0));
}

/** What the scene says and the maps that are edited say again is left out. */
function withoutMaps({ scene, orbit, home, edit }: ViewDocument): ViewDocument {
  const layers = scene.layers.map((layer, i) => {
    if (i > 0) return layer;
    return {
      ...layer,
      transferFunction: edit.map.length > 0 ? undefined : layer.transferFunction,
      densityFunction: edit.second ? undefined : layer.densityFunction,
    };
  });
  return { scene: { ...scene, camera: undefined, layers }, orbit, home, edit };
}

/** Compressed where that is shorter; the first letter says which: "z", else "p". */
async function packed(document: ViewDocument): Promise<string> {
  const plain = new TextEncoder().encode(writeDocument(withoutMaps(document)));
  const dense = await through(plain, new CompressionStream("deflate-raw"));
  return dense.length < plain.length ? `z${toBase64Url(dense)}` : `p${toBase64Url(plain)}`;
}

/** A view is far smaller; a few bytes that unpack to gigabytes are none. */
const kMostBytes = 4 * 1024 * 1024;

async function unpacked(text: string): Promise<ViewDocument | undefined> {
  const bytes = fromBase64Url(text.slice(1));
  if (text[0] === "p") return readDocument(new TextDecoder().decode(bytes));
  if (text[0] !== "z") return undefined;
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let size = 0;
  for (const reader = stream.getReader(); ; ) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value as Uint8Array<ArrayBuffer>);
    size += value.length;
    if (size <= kMostBytes) continue;
    await reader.cancel();
    return undefined;
  }
  return readDocument(await new Blob(parts).text());
}

/** The fragment of an address, with its #; empty where there is nothing to say. */
export async function writeAddress({ places, linked }: Address): Promise<string> {
  const parts = await Promise.all(
    places.map(async (place) =>
      "link" in place ? `link=${place.link}` : `view=${await packed(place.document)}`,
    ),
  );
  if (parts.length > 1 && !linked) parts.push("apart");
  return parts.length > 0 ? `#${parts.join("&")}` : "";
}

/** Reads what writeAddress wrote, and links of the server; a place that cannot be read is `undefined`. */
export async function readAddress(
  fragment: string,
): Promise<{ readonly places: readonly (Place | undefined)[]; readonly linked: boolean }> {
  const entries = [...new URLSearchParams(fragment.replace(/^#/, ""))];
  const places = await Promise.all(
    entries.map(async ([name, value]): Promise<Place | undefined | null> => {
      if (name === "link" && value) return { link: value };
      if (name !== "view") return null;
      const document = await unpacked(value).catch(() => undefined);
      return document && { document };
    }),
  );
  return {
    places: places.filter((place) => place !== null),
    linked: !entries.some(([name]) => name === "apart"),
  };
}
