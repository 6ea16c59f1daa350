import type { Resumption } from "../net/session";
import type { ShareLink } from "./app_state";
import { readDocument, type ViewDocument, writeDocument } from "./document";

/** A view of a page that was reloaded. */
export interface KeptView {
  readonly document: ViewDocument | undefined;
  /** The link that it was joined by. */
  readonly link: string | undefined;
  /** Links to it that were made. */
  readonly links: readonly ShareLink[];
  /** Its number and newest input in the connection that may be resumed. */
  readonly number: number | undefined;
  readonly inputSeq: bigint;
}

/** What a page leaves to the one that is loaded in its place. */
export interface KeptPage {
  /** Of the address: with another one the person wants to see something else. */
  readonly fragment: string;
  readonly linked: boolean;
  readonly views: readonly KeptView[];
  /** Good once, so only a page that ends leaves it: a copy of a living one begins anew. */
  readonly resume: Resumption | undefined;
}

const kVersion = 1;

/** Text for the tab's storage. */
export function writePage(page: KeptPage): string {
  const views = page.views.map(({ document, inputSeq, ...view }) => ({
    ...view,
    document: document && writeDocument(document),
    inputSeq: String(inputSeq),
  }));
  return JSON.stringify({ ...page, views, version: kVersion });
}

type Raw<T> = { readonly [K in keyof T]?: unknown };

const textOr = (value: unknown): string | undefined =>
  typeof value === "string" ? value : undefined;
const numberOr = (value: unknown): number | undefined =>
  Number.isSafeInteger(value) ? (value as number) : undefined;

function readLink(raw: Raw<ShareLink>): ShareLink[] {
  const [role, expires, link] = [numberOr(raw.role), numberOr(raw.expires), textOr(raw.link)];
  return role && expires && link ? [{ role, expires, link }] : [];
}

function readView(raw: Raw<KeptView>): KeptView {
  const links = Array.isArray(raw.links) ? (raw.links as Raw<ShareLink>[]) : [];
  return {
    document: readDocument(textOr(raw.document) ?? null),
    link: textOr(raw.link),
    links: links.flatMap(readLink),
    number: numberOr(raw.number),
    inputSeq: BigInt(textOr(raw.inputSeq) ?? "0"),
  };
}

/** Reads what writePage wrote; undefined for anything else. */
export function readPage(text: string | null): KeptPage | undefined {
  if (!text) return undefined;
  try {
    const raw = JSON.parse(text) as Raw<KeptPage> & { readonly version?: unknown };
    const fragment = textOr(raw.fragment);
    if (raw.version !== kVersion || fragment === undefined || !Array.isArray(raw.views)) {
      return undefined;
    }
    const { token, lastNumber } = (raw.resume ?? {}) as Raw<Resumption>;
    const [name, last] = [textOr(token), numberOr(lastNumber)];
    return {
      fragment,
      linked: raw.linked !== false,
      views: (raw.views as Raw<KeptView>[]).map(readView),
      resume: name && last !== undefined ? { token: name, lastNumber: last } : undefined,
    };
  } catch {
    return undefined;
  }
}
