import type { Browser } from "playwright-core";
import { expect, it } from "vitest";
import { setUp } from "./support/set_up";

const place = setUp();

/** What a first visit may cost on the wire, headers included. */
const kMostBytes = 150 * 1024;

/** Bytes on the wire by path, as the browser counts them; and how the answers were encoded. */
interface Traffic {
  readonly bytes: Map<string, number>;
  readonly encodings: Map<string, string>;
}

/** Visits the page, until all that it needs for its first exact picture is there. */
async function visit(context: Awaited<ReturnType<Browser["newContext"]>>): Promise<Traffic> {
  const page = await context.newPage();
  const devtools = await context.newCDPSession(page);
  await devtools.send("Network.enable");
  const traffic: Traffic = { bytes: new Map(), encodings: new Map() };
  const paths = new Map<string, string>();
  devtools.on("Network.responseReceived", ({ requestId, response }) => {
    const path = new URL(response.url).pathname;
    paths.set(requestId, path);
    const headers = new Map(
      Object.entries(response.headers).map(([name, value]) => [name.toLowerCase(), value]),
    );
    traffic.encodings.set(path, headers.get("content-encoding") ?? "");
  });
  devtools.on("Network.loadingFinished", ({ requestId, encodedDataLength }) => {
    const path = paths.get(requestId);
    if (path && !path.startsWith("/v1/")) traffic.bytes.set(path, encodedDataLength);
  });
  await page.goto(place.url);
  await page.waitForSelector('.badge[data-state="final"]', { state: "attached", timeout: 60_000 });
  await page.waitForSelector(".axes");
  await page.close();
  return traffic;
}

const sumOf = ({ bytes }: Traffic): number => [...bytes.values()].reduce((a, b) => a + b, 0);

/** Bytes of a file that compression may not make smaller. */
const kSmall = 1024;

it("needs less than 150 KB on the wire up to its first exact picture, and little the next time", async () => {
  const context = await place.browser.newContext();
  const first = await visit(context);
  const list = [...first.bytes].map(([name, size]) => `${name} ${size}`).join(", ");
  console.log(`first load: ${list}: ${sumOf(first)}`);
  expect([...first.bytes.keys()].some((name) => name.endsWith(".js"))).toBe(true);
  expect(sumOf(first)).toBeLessThan(kMostBytes);
  expect(
    [...first.bytes.keys()].filter((n) => /measure_results|recorded_file|hud/.test(n)),
  ).toEqual([]);
  for (const [name, encoding] of first.encodings) {
    if ((first.bytes.get(name) ?? 0) < kSmall) continue; // As short without.
    if (/\.(js|css|svg)$/.test(name) || name === "/") expect(encoding, name).toBe("gzip");
  }
  // What has a hash in its name is not asked for again, and the page itself is as it was.
  const again = await visit(context);
  console.log(`second load: ${sumOf(again)}`);
  expect(sumOf(again)).toBeLessThan(4 * 1024);
  await context.close();
});
