import { readFileSync } from "node:fs";
import { join } from "node:path";
import { unzipSync } from "fflate";
import type { Download } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { decodePng, difference, hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 360 } });
});

async function ask(pictures: number, format: string): Promise<void> {
  await client.page.getByRole("button", { name: "View", exact: true }).click();
  const count = client.page.getByLabel("Pictures", { exact: true });
  await count.fill(String(pictures));
  await count.press("Enter");
  await client.page.getByLabel("Save as").selectOption(format);
  await client.page.getByRole("button", { name: "Record", exact: true }).click();
}

async function recorded(pictures: number, format: string): Promise<Download> {
  const [download] = await Promise.all([
    client.page.waitForEvent("download"),
    ask(pictures, format),
  ]);
  await client.page.locator(".recording").waitFor({ state: "detached" });
  return download;
}

describe("a recorded turn", () => {
  it("is lossless pictures of the data from all sides", async () => {
    const home = hashOf(await client.pixels());
    const download = await recorded(4, "png");
    expect(download.suggestedFilename()).toMatch(/^volcast-.*\.zip$/);
    const files = unzipSync(readFileSync(await download.path()));
    expect(Object.keys(files)).toEqual([0, 1, 2, 3].map((i) => `turn-00${i}.png`));
    const pictures = Object.values(files).map((file) => decodePng(file));
    const [first, quarter, half] = pictures;
    if (!first || !quarter || !half) throw new Error("pictures are missing");
    expect(difference(first, quarter).pixels).toBeGreaterThan(500);
    expect(difference(first, half).pixels).toBeGreaterThan(500);
    await client.settled();
    expect(hashOf(await client.pixels())).toBe(home);
    expect(difference(first, await client.pixels()).largest).toBe(0);
  });

  it("is a video that the browser plays, of as many pictures", async () => {
    const download = await recorded(5, "webm");
    expect(download.suggestedFilename()).toMatch(/^volcast-.*\.webm$/);
    const bytes = readFileSync(await download.path());
    const size = (await client.fact("size")).split("x").map(Number);
    // The page's own policy lets it load no media from elsewhere: an empty page plays it.
    const page = await place.browser.newPage();
    const played = await page.evaluate(async (base64) => {
      const data = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const video = document.createElement("video");
      video.muted = true;
      video.src = URL.createObjectURL(new Blob([data], { type: "video/webm" }));
      await video.play();
      await new Promise((resolve) => video.addEventListener("ended", resolve));
      const { totalVideoFrames } = video.getVideoPlaybackQuality();
      return { width: video.videoWidth, height: video.videoHeight, totalVideoFrames };
    }, bytes.toString("base64"));
    await page.close();
    expect([played.width, played.height]).toEqual(size);
    expect(played.totalVideoFrames).toBeGreaterThanOrEqual(5);
  });

  it("can be stopped, and leaves the camera as it was", async () => {
    await client.settled();
    const before = hashOf(await client.pixels());
    await ask(300, "png");
    const stop = client.page.getByRole("button", { name: "Stop", exact: true });
    await stop.waitFor();
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), "recording-760.png") });
    await client.after(() => stop.click());
    await client.page.locator(".recording").waitFor({ state: "detached" });
    expect(hashOf(await client.pixels())).toBe(before);
    await expect.poll(() => client.page.locator(".notice").count()).toBe(0);
  });
});

describe("full screen", () => {
  it("shows the picture on the whole screen, with what lies over it", async () => {
    await client.page.locator(".picture").focus();
    const panel = client.page.locator(".panel");
    await client.after(() => client.page.keyboard.press("f"));
    expect(await client.page.evaluate(() => document.fullscreenElement?.className)).toBe("stage");
    const box = await client.page.locator(".picture canvas").boundingBox();
    expect(await client.fact("size")).toBe(`${box?.width}x${box?.height}`);
    expect(box?.width).toBe(await client.page.evaluate(() => innerWidth));
    await client.after(() => client.page.keyboard.press("f"));
    expect(await client.page.evaluate(() => document.fullscreenElement)).toBeNull();
    await expect.poll(() => panel.isVisible()).toBe(true);
  });
});

describe("performance", () => {
  it("is shown by a key, measures what is drawn and goes away without a trace", async () => {
    const hud = client.page.locator(".hud");
    await expect.poll(() => hud.count()).toBe(0);
    await client.page.locator(".picture").focus();
    await client.page.keyboard.press("h");
    await hud.waitFor();
    await client.after(() => client.drag(60, 20));
    const row = (name: string) => hud.locator("tr", { hasText: name });
    for (const name of ["Input to drawn", "Render", "Encode", "Network", "Decode"]) {
      const [, now] = await row(name).locator("td").allTextContents();
      expect(now, name).toMatch(/^[\d.]+ ms$/);
    }
    const [, frames] = await row("Frames/s").locator("td").allTextContents();
    expect(Number(frames)).toBeGreaterThanOrEqual(0);
    const most = row("Bytes/s").locator("td").last();
    await expect.poll(() => most.textContent()).toMatch(/^\d.* (KB|MB|B)$/);
    const line = await row("Render").locator("polyline").getAttribute("points");
    expect(line?.split(" ").length).toBeGreaterThan(1);
    expect(await violations(client)).toEqual([]);
    await client.page.keyboard.press("h");
    await expect.poll(() => hud.count()).toBe(0);
  });

  it.each([
    ["1280", { viewport: { width: 1280, height: 800 } }],
    ["390", { viewport: { width: 390, height: 844 }, hasTouch: true }],
  ])("is photographed at %s pixels", async (name, options) => {
    const other = await place.open(options);
    await other.page.locator(".picture").focus();
    await other.page.keyboard.press("h");
    await other.page.locator(".hud").waitFor();
    await other.after(() => other.drag(60, 10, 20));
    expect(await violations(other)).toEqual([]);
    await other.page.screenshot({ path: join(screenshotFolder(), `hud-${name}.png`) });
    expect(other.complaints).toEqual([]);
    await other.close();
  });
});
