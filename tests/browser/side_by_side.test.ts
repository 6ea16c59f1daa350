import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const kWide = { viewport: { width: 1000, height: 600 } };

const place = setUp({ page: kWide });

/** The newest exact picture's input of each view. */
const inputs = ({ page }: Client): Promise<number[]> =>
  page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>(".picture")].map((p) =>
      p.dataset.exact === "true" ? Number(p.dataset.inputSeq) : -1,
    ),
  );

/** Waits for an exact picture in `views` views, of a newer input in those of `changing`. */
async function allExact(
  { page }: Client,
  views: number,
  changing: readonly number[] = [],
  before: readonly number[] = [],
): Promise<void> {
  await page.waitForFunction(
    ([count, changes, old]) => {
      const all = [...document.querySelectorAll<HTMLElement>(".picture")];
      const dots = document.querySelectorAll('.pane-dot[data-state="final"]').length;
      const seq = (i: number): number => Number(all[i]?.dataset.inputSeq ?? 0);
      return (
        all.length === count &&
        (count === 1 || dots === count) &&
        all.every((p) => p.dataset.exact === "true") &&
        changes.every((i) => seq(i) > (old[i] ?? 0))
      );
    },
    [views, changing, before] as const,
    { timeout: 60_000 },
  );
}

async function change(
  client: Client,
  views: number,
  changing: readonly number[],
  act: () => Promise<void>,
): Promise<void> {
  const before = await inputs(client);
  await act();
  await allExact(client, views, changing, before);
}

async function addView(client: Client, views: number): Promise<void> {
  await client.page.getByRole("button", { name: "Another view beside this one" }).click();
  await allExact(client, views);
}

async function dragIn({ page }: Client, view: number, dx: number, dy: number): Promise<void> {
  const box = await page.locator(".picture").nth(view).boundingBox();
  if (!box) throw new Error("no such view");
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 6 });
  await page.mouse.up();
}

const picture = async (client: Client, view: number): Promise<string> =>
  hashOf(await client.pixels(view));

describe("views side by side", () => {
  it("show the same, and move together", async () => {
    const client = await place.open();
    await addView(client, 2);
    const before = await picture(client, 0);
    expect(await picture(client, 1)).toBe(before);
    await change(client, 2, [0, 1], () => dragIn(client, 0, 80, 30));
    expect(await picture(client, 0)).not.toBe(before);
    expect(await picture(client, 1)).toBe(await picture(client, 0));
    await change(client, 2, [0, 1], () => dragIn(client, 1, -40, 10));
    expect(await picture(client, 1)).toBe(await picture(client, 0));
  });

  it("have settings of their own, shown for the active one", async () => {
    const client = await place.open();
    await addView(client, 2);
    const radio = client.page.getByRole("radio", { name: "Maximum", exact: true });
    await change(client, 2, [1], () => radio.check({ force: true }));
    expect(await picture(client, 1)).not.toBe(await picture(client, 0));
    await client.page.getByRole("button", { name: /^1: / }).click();
    await expect.poll(() => radio.isChecked()).toBe(false);
    const row = client.page.locator(".dataset:not([data-shown])").first();
    await change(client, 2, [0], () => row.locator(".dataset-choose").click());
    const other = await picture(client, 0);
    await change(client, 2, [0, 1], () => dragIn(client, 1, 70, 0));
    expect(await picture(client, 0)).not.toBe(other);
  });

  it("move by themselves where cameras are apart", async () => {
    const client = await place.open();
    await addView(client, 2);
    await client.page.getByLabel("Cameras together").uncheck();
    const still = await picture(client, 0);
    await change(client, 2, [1], () => dragIn(client, 1, 80, 30));
    expect(await picture(client, 0)).toBe(still);
    expect(await picture(client, 1)).not.toBe(still);
  });

  it("are reached and closed by keyboard", async () => {
    const client = await place.open();
    await addView(client, 2);
    const { page } = client;
    await page.getByLabel("Cameras together").uncheck();
    const [first, second] = [await picture(client, 0), await picture(client, 1)];
    await page.locator(".picture").first().focus();
    await change(client, 2, [0], () => page.keyboard.press("ArrowLeft"));
    expect(await picture(client, 0)).not.toBe(first);
    expect(await picture(client, 1)).toBe(second);
    const close = page.getByRole("button", { name: "Close view 1" });
    await close.focus();
    await page.keyboard.press("Enter");
    await page.locator(".pane-head").first().waitFor({ state: "detached" });
    await expect.poll(() => page.locator(".picture").count()).toBe(1);
    await client.settled();
  });

  it("stay over a reload, and open from the address", async () => {
    const client = await place.open();
    await addView(client, 2);
    const radio = client.page.getByRole("radio", { name: "Surface", exact: true });
    await change(client, 2, [1], () => radio.check({ force: true }));
    await client.page.waitForFunction(() => location.hash.split("view=").length === 3);
    await client.page.getByLabel("Cameras together").uncheck();
    await client.page.waitForURL(/&apart$/);
    const before = [await picture(client, 0), await picture(client, 1)];
    const other = await place.visit({}, client.page.url());
    await allExact(other, 2);
    await client.page.reload();
    await allExact(client, 2);
    for (const page of [client, other]) {
      expect([await picture(page, 0), await picture(page, 1)]).toEqual(before);
      await expect.poll(() => page.page.getByLabel("Cameras together").isChecked()).toBe(false);
    }
  });

  it("are four at most", async () => {
    const client = await place.open();
    for (const count of [2, 3, 4]) await addView(client, count);
    const more = client.page.getByRole("button", { name: "Another view beside this one" });
    await expect.poll(() => more.getAttribute("aria-disabled")).toBe("true");
    await client.page.screenshot({ path: join(screenshotFolder(), "1000-four-views.png") });
    await change(client, 4, [0, 1, 2, 3], () => dragIn(client, 3, 50, 0));
    const all = new Set<string>();
    for (let i = 0; i < 4; i += 1) all.add(await picture(client, i));
    expect(all.size).toBe(1);
  });

  it.each([
    { name: "1280-light", viewport: { width: 1280, height: 800 }, colorScheme: "light" as const },
    {
      name: "390-dark",
      viewport: { width: 390, height: 844 },
      colorScheme: "dark" as const,
      hasTouch: true,
      isMobile: true,
    },
  ])("fit at $name, accessible and photographed", async ({ name, ...options }) => {
    const client = await place.open(options);
    await addView(client, 2);
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), `${name}-two-views.png`) });
    const overflow = await client.page.evaluate(
      () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
    );
    expect(overflow).toBe(0);
  });
});
