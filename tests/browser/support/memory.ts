import { readFileSync } from "node:fs";
import type { CDPSession, Page } from "playwright-core";

/** What a page holds, after its garbage was collected. */
export interface Held {
  /** Of the page's own thread: objects, and the bytes of its buffers. */
  readonly heapBytes: number;
  readonly nodes: number;
  readonly listeners: number;
  /** Blob URLs that were made and not revoked, and bitmaps of the page's own thread that were not closed. */
  readonly urls: number;
  readonly bitmaps: number;
  /** Of all page processes, so with what workers and decoders hold. */
  readonly residentBytes: number;
}

interface Counted {
  held: { urls: number; bitmaps: number };
}

const kPageBytes = 4096; // Of Linux on x86-64 and arm64.

/** Counts what must be given back by hand; before the page is loaded. */
export async function countHeld(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const held = { urls: 0, bitmaps: 0 };
    Object.assign(window, { held });
    const { createObjectURL, revokeObjectURL } = URL;
    URL.createObjectURL = (what) => {
      held.urls += 1;
      return createObjectURL.call(URL, what);
    };
    URL.revokeObjectURL = (url) => {
      held.urls -= 1;
      revokeObjectURL.call(URL, url);
    };
    const make = window.createImageBitmap as (...given: unknown[]) => Promise<ImageBitmap>;
    window.createImageBitmap = async (...given: unknown[]) => {
      const bitmap = await make.apply(window, given);
      held.bitmaps += 1;
      return bitmap;
    };
    const { close } = ImageBitmap.prototype;
    ImageBitmap.prototype.close = function closeCounted() {
      held.bitmaps -= 1;
      close.call(this);
    };
  });
}

async function residentBytes(browser: CDPSession): Promise<number> {
  const { processInfo } = await browser.send("SystemInfo.getProcessInfo");
  const pages = processInfo.filter(({ type }) => type === "renderer");
  const sizes = pages.map(({ id }) => readFileSync(`/proc/${id}/statm`, "utf8").split(" ")[1]);
  return sizes.reduce((sum, pagesHeld) => sum + kPageBytes * Number(pagesHeld), 0);
}

export async function heldBy(page: Page): Promise<Held> {
  const own = await page.context().newCDPSession(page);
  const browser = await page.context().browser()?.newBrowserCDPSession();
  if (!browser) throw new Error("the page has no browser");
  // Twice: what finalizers let go is collected by the second.
  for (let i = 0; i < 2; i += 1) await own.send("HeapProfiler.collectGarbage");
  await own.send("Performance.enable");
  const { metrics } = await own.send("Performance.getMetrics");
  const metric = (name: string): number =>
    metrics.find((m) => m.name === name)?.value ?? Number.NaN;
  const heap = await own.send("Runtime.getHeapUsage");
  const counts = await page.evaluate(() => ({ ...(window as unknown as Counted).held }));
  const held = {
    heapBytes: heap.usedSize + heap.embedderHeapUsedSize + heap.backingStorageSize,
    nodes: metric("Nodes"),
    listeners: metric("JSEventListeners"),
    ...counts,
    residentBytes: await residentBytes(browser),
  };
  await own.detach();
  await browser.detach();
  return held;
}
