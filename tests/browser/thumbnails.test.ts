import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 900 } });
  await client.choose("demo:mesh");
});

const thumbs = () => client.page.locator(".model-thumb canvas");

/** Every thumbnail was drawn as often as that, at least. */
const drawn = (times: number): Promise<unknown> =>
  client.page.waitForFunction(
    (least) => {
      const all = [...document.querySelectorAll<HTMLElement>(".model-thumb canvas")];
      return all.length > 0 && all.every((one) => Number(one.dataset.drawn ?? 0) >= least);
    },
    times,
    { timeout: 60_000 },
  );

/** By model, what its canvas shows. */
const pictures = (): Promise<string[]> =>
  client.page.evaluate(() =>
    [...document.querySelectorAll<HTMLCanvasElement>(".model-thumb canvas")].map((one) => {
      const { data } = one.getContext("2d")?.getImageData(0, 0, one.width, one.height) ?? {
        data: [],
      };
      return [...data].join();
    }),
  );

describe("thumbnails of the ray models", () => {
  it("are there once they are asked for, one for each model, all different", async () => {
    await expect.poll(() => thumbs().count()).toBe(0);
    await client.page.getByRole("button", { name: "Pictures" }).click();
    await drawn(1);
    const models = await client.page.getByRole("radio").count();
    await expect.poll(() => thumbs().count()).toBe(models);
    expect(new Set(await pictures()).size).toBe(models);
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), "thumbnails-760.png") });
  });

  it("follow the camera when it has come to rest", async () => {
    const before = await pictures();
    await client.after(() => client.drag(120, 30));
    await drawn(2);
    const after = await pictures();
    expect(after.every((one, i) => one !== before[i])).toBe(true);
  });

  it("stay as they are when a model is chosen", async () => {
    const count = (): Promise<string[]> =>
      thumbs().evaluateAll((all) => all.map((one) => (one as HTMLElement).dataset.drawn ?? ""));
    const before = await count();
    await client.after(() =>
      client.page.getByRole("radio", { name: "Maximum", exact: true }).check({ force: true }),
    );
    // What would be asked for anew is asked for before a later change of the camera.
    await client.after(() => client.drag(-60, 0));
    await drawn(3);
    const after = await count();
    expect(after).toEqual(before.map((times) => String(Number(times) + 1)));
  });

  it("fit 390 pixels, and are kept over a reload", async () => {
    await client.after(() => client.page.setViewportSize({ width: 390, height: 844 }));
    await client.page.reload();
    await client.settled();
    const toggle = client.page.locator(".sheet-toggle");
    if ((await toggle.getAttribute("aria-expanded")) === "false") {
      await client.after(() => toggle.click());
    }
    await thumbs().first().scrollIntoViewIfNeeded();
    await drawn(1);
    await client.page.screenshot({ path: join(screenshotFolder(), "thumbnails-390.png") });
    expect(await violations(client)).toEqual([]);
    await client.page.getByRole("button", { name: "Pictures" }).click();
    await expect.poll(() => thumbs().count()).toBe(0);
    expect(client.complaints).toEqual([]);
  });
});
