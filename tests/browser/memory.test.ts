import { expect, it } from "vitest";
import { countHeld, type Held, heldBy } from "./support/memory";
import { setUp } from "./support/set_up";

const place = setUp({ page: { viewport: { width: 420, height: 360 } } });

/** Pictures between the two looks, and so long at most. */
const kPictures = Number(process.env.VOLCAST_MEMORY_FRAMES ?? 600);
const kLongestMs = 50 * kPictures;
/** Before the first look: caches and lists of the newest (200 latencies) are full then. */
const kWarmUp = 300;
/** Fewer say nothing. */
const kFewest = 100;

/**
 * What may be more after a picture. A frame that is kept has its header (its payload goes to the worker): an object
 * of 18 fields with two more of 8 and 11, so more than 512 bytes. Half of that, and once 1 MB for what the engine
 * compiles and caches meanwhile (0.2 to 0.6 MB were seen): kept headers are more from about 4,000 pictures on, so
 * in the long run; the short one finds what is larger, or is counted below.
 */
const kMostHeapBytes = 256;
const kOnceBytes = 2 ** 20;
/** Of what is one thing a picture where it is left behind at all: nodes, listeners, URLs, bitmaps. */
const kMostThings = 1 / 20;

/** Turns the camera by keys, one an animation frame, until `pictures` were drawn; how many were. */
function turn(pictures: number, longestMs: number): Promise<number> {
  return new Promise((resolve) => {
    let seen = 0;
    const end = performance.now() + longestMs;
    const look = new MutationObserver((changes) => {
      seen += changes.length;
    });
    const picture = document.querySelector(".picture");
    if (picture) look.observe(picture, { attributeFilter: ["data-input-seq"] });
    const next = (): void => {
      if (seen >= pictures || performance.now() > end) {
        look.disconnect();
        resolve(seen);
        return;
      }
      document.body.dispatchEvent(
        new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true, cancelable: true }),
      );
      requestAnimationFrame(next);
    };
    next();
  });
}

it("what pictures leave behind does not grow with them", {
  timeout: 120_000 + 2 * kLongestMs,
}, async () => {
  const client = await place.visit();
  await countHeld(client.page);
  await client.page.reload();
  await client.settled();
  const run = async (pictures: number, longestMs: number): Promise<number> => {
    let drawn = 0;
    await client.after(async () => {
      drawn = await client.page.evaluate(`(${turn.toString()})(${pictures}, ${longestMs})`);
    });
    return drawn;
  };
  await run(kWarmUp, 150 * kWarmUp);
  const before = await heldBy(client.page);
  const drawn = await run(kPictures, kLongestMs);
  const after = await heldBy(client.page);
  const [width = 0, height = 0] = (await client.fact("size")).split("x").map(Number);
  const grown = (name: keyof Held): number => after[name] - before[name];
  const kb = (name: keyof Held): string => (grown(name) / 1024).toFixed(0);
  console.info(
    `after ${drawn} pictures of ${width}x${height}: heap ${(before.heapBytes / 1024).toFixed(0)} KB ` +
      `and ${kb("heapBytes")} more, resident ${(before.residentBytes / 1024).toFixed(0)} KB and ` +
      `${kb("residentBytes")} more, ${before.nodes} nodes and ${grown("nodes")} more, ${before.listeners} ` +
      `listeners and ${grown("listeners")} more, ${after.urls} URLs, ${after.bitmaps} bitmaps`,
  );
  expect(drawn).toBeGreaterThan(kFewest);
  expect(grown("heapBytes")).toBeLessThan(kOnceBytes + kMostHeapBytes * drawn);
  for (const name of ["nodes", "listeners", "urls", "bitmaps"] as const) {
    expect(grown(name), name).toBeLessThan(kMostThings * drawn);
  }
  // Decoded pictures that nobody closed, wherever: four bytes a pixel.
  expect(grown("residentBytes")).toBeLessThan((width * height * 4 * drawn) / 2);
});
