import { mkdirSync } from "node:fs";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import { Client, launch } from "./support/client";
import { hashOf } from "./support/pixels";
import { Server, screenshotFolder } from "./support/server";

let server: Server;
let browser: Browser;
let client: Client;
const kMeasuredMs = 90_000;

beforeAll(async () => {
  mkdirSync(screenshotFolder(), { recursive: true });
  server = await Server.start();
  browser = await launch();
  client = await Client.open(browser, server.url, { viewport: { width: 1280, height: 900 } });
  const row = client.page.locator('.dataset[data-dataset="demo:mesh"]');
  if ((await row.getAttribute("data-shown")) === null) {
    await client.after(() => row.locator(".dataset-choose").click());
  }
  await slider().waitFor();
});

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

const slider = () => client.page.getByRole("slider", { name: "From fastest to exact" });
const picture = async (): Promise<string> => hashOf(await client.pixels());
const said = async (): Promise<string> => (await slider().getAttribute("aria-valuetext")) ?? "";
const source = (name: string) =>
  client.page.waitForSelector(`.accuracy-slider input[data-source="${name}"]`, {
    timeout: kMeasuredMs,
  });

describe("the slider from fastest to exact", () => {
  it("knows the order of the ways, and estimates once it is reached for", async () => {
    await source("order");
    expect(await slider().getAttribute("max")).toBe("5");
    expect(await said()).toBe("Exact");
    await slider().focus();
    await source("estimated");
    const status = client.page.locator(".accuracy-slider [role=status]");
    expect(await status.textContent()).toMatch(/^Estimated/);
    expect(await said()).toMatch(/^Exact: .* ms, error at most .* \(1\/255\)$/);
    expect(await violations(client)).toEqual([]);
    await client.page.locator(".accuracy-slider").scrollIntoViewIfNeeded();
    await client.page.screenshot({ path: join(screenshotFolder(), "slider-estimated-1280.png") });
  });

  it("draws by the way it stands at, with the keyboard", async () => {
    const exact = await picture();
    await client.after(() => slider().press("Home"));
    expect(await slider().inputValue()).toBe("0");
    const rough = await picture();
    expect(rough).not.toBe(exact);
    await client.after(() => slider().press("End"));
    expect(await picture()).toBe(exact);
    const undo = () => client.page.getByRole("button", { name: "Undo" }).click();
    await client.after(undo);
    expect(await picture()).toBe(rough);
    await client.after(undo);
    expect(await picture()).toBe(exact);
  });

  it("has the front of what was measured, and the chart marks where it stands", async () => {
    await client.page.getByRole("button", { name: "Measure", exact: true }).click();
    await source("measured");
    await client.page
      .getByRole("button", { name: "Measure", exact: true })
      .waitFor({ timeout: kMeasuredMs });
    const front = await client.page.locator(".chart-point[data-front]").count();
    expect(await slider().getAttribute("max")).toBe(String(front - 1));
    await slider().press("End");
    await client.after(() => slider().press("Home"));
    const pressed = client.page.locator('.chart-point[aria-pressed="true"]');
    expect(await pressed.count()).toBe(1);
    expect(await pressed.getAttribute("data-front")).toBe("");
    const way = (await said()).split(":")[0] ?? "";
    expect(await pressed.getAttribute("aria-label")).toContain(`${way}: `);
    expect(await violations(client)).toEqual([]);
  });

  it("leaves the choice to the wish again", async () => {
    const automatic = client.page.getByRole("button", { name: "As the wish asks", exact: true });
    await client.after(() => automatic.click());
    expect(await automatic.count()).toBe(0);
  });

  it.each([
    ["1280", { width: 1280, height: 900 }],
    ["390", { width: 390, height: 844 }],
  ])("fits %s pixels", async (name, size) => {
    await client.after(() => client.page.setViewportSize({ width: 800, height: 700 }));
    await client.after(() => client.page.setViewportSize(size));
    await client.page.locator(".accuracy-slider").scrollIntoViewIfNeeded();
    await client.page.screenshot({ path: join(screenshotFolder(), `slider-${name}.png`) });
    expect(await violations(client)).toEqual([]);
    const body = client.page.locator(".panel-body");
    expect(await body.evaluate((e) => e.scrollWidth - e.clientWidth)).toBe(0);
  });
});
