import { gzipSync } from "node:zlib";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { launch } from "./support/client";
import { Server } from "./support/server";

let server: Server;
let browser: Browser;

beforeAll(async () => {
  server = await Server.start();
  browser = await launch();
});

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

/** What a first visit may cost, as a proxy that compresses sends it. */
const kMostBytes = 150 * 1024;

it("needs less than 150 KB, compressed, up to its first exact picture", async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  const bodies: Promise<[string, number]>[] = [];
  page.on("response", (response) => {
    const size = response
      .body()
      .then((body): [string, number] => [new URL(response.url()).pathname, gzipSync(body).length]);
    bodies.push(size);
  });
  await page.goto(server.url);
  await page.waitForSelector('.badge[data-state="final"]', { state: "attached", timeout: 60_000 });
  await page.waitForSelector(".axes");
  const sizes = await Promise.all(bodies);
  const sum = sizes.reduce((all, [, size]) => all + size, 0);
  console.log(`first load: ${sizes.map(([name, size]) => `${name} ${size}`).join(", ")}: ${sum}`);
  expect(sizes.some(([name]) => name.endsWith(".js"))).toBe(true);
  expect(sum).toBeLessThan(kMostBytes);
  expect(sizes.some(([name]) => /measure_results|recorded_file|hud/.test(name))).toBe(false);
  await context.close();
});
