import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 640, height: 1400 } });
  const toggle = client.page.locator(".sheet-toggle");
  if (await toggle.isVisible()) await client.after(() => toggle.click());
});

const points = () => client.page.locator(".chart-point");
const measure = () => client.page.getByRole("button", { name: "Measure", exact: true });
const status = () =>
  client.page.locator('section[aria-labelledby="measure-heading"] [role=status]');
const kMeasuredMs = 90_000;
const kHead = "#measure-heading";

async function photograph(name: string, what: string): Promise<void> {
  await client.page.locator(what).scrollIntoViewIfNeeded();
  await client.page.screenshot({ path: join(screenshotFolder(), `${name}.png`) });
}

describe("error against time", () => {
  it("is measured on request, with points as the ways are done", async () => {
    await measure().click();
    await points().first().waitFor({ timeout: kMeasuredMs });
    await measure().waitFor({ timeout: kMeasuredMs });
    await expect.poll(() => status().textContent()).toBe("");
    // Volume of a mesh: six integrators by walk and by projection.
    await expect.poll(() => points().count()).toBe(12);
    await expect
      .poll(() => client.page.locator(".chart-point[data-front]").count())
      .toBeGreaterThan(0);
    expect(await violations(client)).toEqual([]);
  });

  it("draws by the point that is clicked, and automatically again", async () => {
    const before = hashOf(await client.pixels());
    const rough = client.page.getByRole("button", { name: /^Average · projection: / });
    const box = await rough.boundingBox();
    if (!box) throw new Error("the point has no box");
    const { x, y } = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    await client.after(() => client.page.mouse.click(x, y));
    await expect.poll(() => rough.getAttribute("aria-pressed")).toBe("true");
    expect(hashOf(await client.pixels())).not.toBe(before);
    await expect.poll(() => status().textContent()).toBe("");
    const automatic = client.page.getByRole("button", { name: "Automatic", exact: true });
    await client.after(() => automatic.click());
    expect(hashOf(await client.pixels())).toBe(before);
  });

  it("is used by keys alone", async () => {
    await client.page.locator('.chart-point[tabindex="0"]').focus();
    await client.page.keyboard.press("ArrowRight");
    await client.after(() => client.page.keyboard.press("Enter"));
    await photograph("accuracy-640", ".chart-key");
    const pressed = client.page.locator('.chart-point[aria-pressed="true"]');
    await expect.poll(() => pressed.count()).toBe(1);
    expect(await pressed.evaluate((e) => e === document.activeElement)).toBe(true);
  });

  it("is a table with the same rows and buttons", async () => {
    await client.page.getByText("In numbers").click();
    await expect.poll(() => client.page.locator(".accuracy-table tbody tr").count()).toBe(12);
    const row = client.page.locator(".accuracy-table button", { hasText: "Exact · walk" });
    await client.after(() => row.click());
    await expect.poll(() => row.getAttribute("aria-pressed")).toBe("true");
    expect(await violations(client)).toEqual([]);
    await photograph("accuracy-table-640", ".accuracy-table");
  });

  it.each([
    ["1280", { width: 1280, height: 800 }],
    ["390", { width: 390, height: 844 }],
  ])("fits %s pixels", async (name, size) => {
    await client.after(() => client.page.setViewportSize(size));
    await photograph(`accuracy-${name}`, ".accuracy-table");
    expect(await violations(client)).toEqual([]);
    const body = client.page.locator(".panel-body");
    expect(await body.evaluate((e) => e.scrollWidth - e.clientWidth)).toBe(0);
    await client.after(() => client.page.setViewportSize({ width: 640, height: 1400 }));
  });

  it("says that it is of an earlier view, once the camera turned", async () => {
    await client.after(() => client.drag(80, 20));
    await expect.poll(() => status().textContent()).toMatch(/as it was when/);
  });

  it("stops on request and when the view changes, and says why", async () => {
    await measure().click();
    await client.page.getByRole("button", { name: "Stop", exact: true }).click();
    await measure().waitFor();
    await expect.poll(() => status().textContent()).toMatch(/^Stopped: stopped by the client/);
    await measure().click();
    await client.page.getByRole("button", { name: "Stop", exact: true }).waitFor();
    await client.after(() => client.drag(-80, -20));
    await measure().waitFor();
    await expect.poll(() => status().textContent()).toMatch(/^Stopped: the view changed/);
  });
});

describe("when nothing happens", () => {
  const wish = () => client.page.getByLabel("Also when nothing happens");

  const stop = () => client.page.getByRole("button", { name: "Stop", exact: true });

  it("is measured by itself if that is wished for, and begins anew when the view changed", async () => {
    await client.after(() => client.page.setViewportSize({ width: 640, height: 700 }));
    await wish().check();
    await stop().waitFor();
    await points().first().waitFor({ timeout: kMeasuredMs });
    expect(await violations(client)).toEqual([]);
    await photograph("measure-idle-640", kHead);
    await client.after(() => client.drag(-20, 15));
    await expect.poll(() => status().textContent()).toMatch(/^Stopped: the view changed/);
    await stop().waitFor();
  });

  it("ends when its place is scrolled away, and goes on when it is back", async () => {
    await client.page.locator(".dataset").first().scrollIntoViewIfNeeded();
    await measure().waitFor();
    await expect.poll(() => status().textContent()).toMatch(/^Stopped: stopped by the client/);
    await client.page.locator(kHead).scrollIntoViewIfNeeded();
    await stop().click();
    await measure().waitFor();
    await wish().uncheck();
    await client.after(() => client.page.setViewportSize({ width: 640, height: 1400 }));
  });
});

describe("how it is drawn", () => {
  const plan = () => client.page.locator(".plan");

  it("lists effects with their reasons, for the newest picture", async () => {
    await client.page.getByText("How it is drawn").click();
    await plan().waitFor();
    const names = await client.page.locator(".effect-name").allTextContents();
    expect(new Set(names).size).toBe(names.length);
    expect(names.length).toBeGreaterThan(3);
    const reasons = await client.page.locator(".effect-reason").allTextContents();
    expect(reasons.every((r) => r.length > 5)).toBe(true);
    await expect.poll(() => plan().textContent()).toContain("exact");
    expect(await violations(client)).toEqual([]);
    await photograph("explain-640", ".plan-times");
  });

  it("follows the picture", async () => {
    const newest = async (): Promise<void> => {
      const seq = await client.fact("inputSeq");
      await client.page.waitForSelector(`.plan[data-input-seq="${seq}"]`);
    };
    await newest();
    await client.after(() => client.drag(30, 0));
    await newest();
    const before = await plan().textContent();
    const radio = client.page.getByRole("radio", { name: "Surface", exact: true });
    await client.after(() => radio.check({ force: true }));
    await newest();
    await expect.poll(() => plan().textContent()).not.toBe(before);
  });

  it("measures what each effect that is on takes, of this very picture", async () => {
    await client.choose("demo:volume");
    await client.after(() => client.page.getByLabel("Light", { exact: true }).check());
    const seq = await client.fact("inputSeq");
    await client.page.waitForSelector(`.plan[data-input-seq="${seq}"]`);
    const effects = client.page.locator(".effect");
    const light = effects.filter({ has: client.page.locator('.effect-name:text-is("light")') });
    await expect.poll(() => light.getAttribute("data-on")).toBe("");
    await expect.poll(() => light.locator(".effect-state").innerText()).toBe("on");
    await expect.poll(() => light.locator(".effect-ms").innerText()).toBe("");
    await client.page.getByRole("button", { name: "Measure the effects" }).click();
    const said = client.page.locator(".effect-times [role=status]");
    await said
      .filter({ hasText: /^Of .* ms that this picture takes/ })
      .waitFor({ timeout: 60_000 });
    await expect
      .poll(() => light.locator(".effect-ms").innerText())
      .toMatch(/^(saves )?[\d.]+ ms$/);
    const off = client.page.locator(".effect:not([data-on])");
    expect(await off.count()).toBeGreaterThan(0);
    expect((await off.locator(".effect-ms").allInnerTexts()).join("")).toBe("");
    expect(await violations(client)).toEqual([]);
    await photograph("effects-640", ".effect-times");
    await client.after(() => client.drag(20, 0));
    await expect.poll(() => light.locator(".effect-ms").innerText()).toBe("");
  });

  it("is asked for only while it is open", async () => {
    await client.page.getByText("How it is drawn").click();
    await plan().waitFor({ state: "detached" });
    expect(client.complaints).toEqual([]);
  });
});
