import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp({ page: { viewport: { width: 760, height: 700 } } });
let client: Client;

beforeAll(async () => {
  client = await place.open();
  await client.page.getByText("What is sent").click();
  await client.page.locator(".pace-facts").waitFor();
});

const choose = (label: string, option: string): Promise<string[]> =>
  client.page.getByRole("combobox", { name: label, exact: true }).selectOption({ label: option });

/** Sizes of the pictures that moving the camera brings, without the last, which is exact. */
async function sizesMoving(): Promise<Set<string>> {
  await client.page.evaluate(() => {
    const seen = new Set<string>();
    const picture = document.querySelector<HTMLElement>(".picture");
    const look = new MutationObserver(() => {
      if (picture?.dataset.lossless === "false") seen.add(picture.dataset.size ?? "");
    });
    if (picture) look.observe(picture, { attributeFilter: ["data-sequence"] });
    Object.assign(window, { seenSizes: seen });
  });
  await client.after(() => client.drag(60, 20, 20));
  return new Set(
    await client.page.evaluate(() => [
      ...(window as unknown as { seenSizes: Set<string> }).seenSizes,
    ]),
  );
}

describe("what is sent", () => {
  it("is said, with what the server goes by and why", async () => {
    const now = client.page.locator(".pace-now");
    await expect.poll(() => now.textContent()).toMatch(/lossless, full size, .*\.$/);
    await expect.poll(() => client.page.locator(".pace-reason").textContent()).toMatch(/.{10}/);
    await expect
      .poll(() => client.page.locator(".pace-facts dd").allInnerTexts())
      .toEqual([
        expect.stringMatching(/ ms$/),
        expect.stringMatching(/ ms$/),
        expect.stringMatching(/^\d+ of \d+$/),
        expect.stringMatching(/\/s$|^–$/),
      ]);
    expect(await violations(client)).toEqual([]);
  });

  it("keeps the size that is pinned, and the exact picture is whole all the same", async () => {
    const full = await client.fact("size");
    const [width = 0, height = 0] = full.split("x").map(Number);
    await choose("Size", "Half");
    const half = await sizesMoving();
    expect([...half]).toContain(`${Math.round(width / 2)}x${Math.round(height / 2)}`);
    await client.page.locator(".pace").scrollIntoViewIfNeeded();
    await client.page.screenshot({ path: join(screenshotFolder(), "pins-760.png") });
    // The exact picture is whole all the same.
    expect(await client.fact("size")).toBe(full);
    expect(hashOf(await client.sent())).toBe(hashOf(await client.pixels()));
    await client.page.getByRole("button", { name: "All automatic" }).click();
    await choose("Size", "Full");
    expect([...(await sizesMoving())]).toEqual([full]);
  });

  it("has a quality of one's own, as the pictures say", async () => {
    await choose("Quality", "30");
    await choose("Drawn", "As fast as possible");
    await choose("Pictures/s", "120");
    const said = client.page.evaluate(
      () =>
        new Promise<string>((resolve) => {
          const now = document.querySelector(".pace-now");
          const look = new MutationObserver(() => {
            const text = now?.textContent ?? "";
            if (text.includes("quality 30")) resolve(text);
          });
          if (now) look.observe(now, { characterData: true, childList: true, subtree: true });
        }),
    );
    await client.after(() => client.drag(-50, 10, 20));
    expect(await said).toMatch(
      /quality 30, .*drawn faster, less accurate, at most 120 pictures\/s/,
    );
    expect(await violations(client)).toEqual([]);
    expect(await client.page.locator(".refusal, .notice").count()).toBe(0);
  });
});
