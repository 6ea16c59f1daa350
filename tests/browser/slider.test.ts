import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;
const kMeasuredMs = 90_000;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 700 } });
  await client.choose("demo:mesh");
  await slider().waitFor();
});

const slider = () => client.page.getByRole("slider", { name: "From fastest to exact" });
const picture = async (): Promise<string> => hashOf(await client.pixels());
const said = async (): Promise<string> => (await slider().getAttribute("aria-valuetext")) ?? "";
const source = (name: string) =>
  client.page.waitForSelector(`.accuracy-slider input[data-source="${name}"]`, {
    timeout: kMeasuredMs,
  });

/** Moves the slider; waits for the picture of it, unless it stands at that end already. */
const press = async (key: "Home" | "ArrowRight"): Promise<unknown> => {
  const end = key === "Home" ? "0" : await slider().getAttribute("max");
  const there = (await slider().inputValue()) === end;
  return there ? slider().press(key) : client.after(() => slider().press(key));
};

/** How many stops it has depends on the times; one of a single stop stays and says why. */
const saysWhyThereIsOne = async (): Promise<void> => {
  if ((await slider().getAttribute("max")) !== "0") return;
  const status = client.page.locator(".accuracy-slider [role=status]");
  expect(await status.textContent()).toContain("both the fastest and the most accurate");
};

describe("the slider from fastest to exact", () => {
  it("knows the order of the ways, and estimates once it is reached for", async () => {
    await source("order");
    await expect.poll(() => slider().getAttribute("max")).toBe("5");
    expect(await said()).toBe("Exact");
    await slider().focus();
    await source("estimated");
    const status = client.page.locator(".accuracy-slider [role=status]");
    await expect.poll(() => status.textContent()).toMatch(/^Estimated/);
    expect(await said()).toMatch(/^Exact: .* ms, error at most .* \(1\/255\)$/);
    expect(await violations(client)).toEqual([]);
    await client.page.locator(".accuracy-slider").scrollIntoViewIfNeeded();
    await client.page.screenshot({ path: join(screenshotFolder(), "slider-estimated-760.png") });
  });

  it("draws by the way it stands at, with the keyboard", async () => {
    const exact = await picture();
    await client.after(() => slider().press("Home"));
    await expect.poll(() => slider().inputValue()).toBe("0");
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
    await expect.poll(() => slider().getAttribute("max")).toBe(String(front - 1));
    await saysWhyThereIsOne();
    if (front > 1) {
      await slider().press("End");
      await press("Home");
    } else {
      // By key: neighbouring points may cover it.
      const only = client.page.locator(".chart-point[data-front]");
      await client.after(() => only.press("Enter"));
    }
    const pressed = client.page.locator('.chart-point[aria-pressed="true"]');
    await expect.poll(() => pressed.count()).toBe(1);
    await expect.poll(() => pressed.getAttribute("data-front")).toBe("");
    const way = (await said()).split(":")[0] ?? "";
    await expect.poll(() => pressed.getAttribute("aria-label")).toContain(`${way}: `);
    expect(await violations(client)).toEqual([]);
  });

  it("leaves the choice to the wish again", async () => {
    const automatic = client.page.getByRole("button", { name: "As the wish asks", exact: true });
    await client.after(() => automatic.click());
    await expect.poll(() => automatic.count()).toBe(0);
  });

  it("has times of voxels too, once it is reached for", async () => {
    await client.choose("demo:volume");
    const volume = client.page.getByRole("radio", { name: /^Volume/ });
    if (!(await volume.isChecked())) await client.after(() => volume.check({ force: true }));
    // So far apart that integrators differ.
    const samples = client.page.getByRole("combobox", { name: "Samples", exact: true });
    await client.after(async () => void (await samples.selectOption("By their number")));
    await client.after(async () => {
      await client.page.getByRole("textbox", { name: "Samples over the depth" }).fill("6");
      await client.page.keyboard.press("Enter");
    });
    await slider().blur();
    await slider().focus();
    await source("estimated");
    const last = Number(await slider().getAttribute("max"));
    await saysWhyThereIsOne();
    const times: number[] = [];
    for (let stop = 0; stop <= last; stop += 1) {
      await press(stop === 0 ? "Home" : "ArrowRight");
      await expect.poll(said).toMatch(/: [\d.]+ ms, error at most/);
      times.push(Number(/: ([\d.]+) ms/.exec(await said())?.[1]));
    }
    expect(times.every((ms) => ms > 0)).toBe(true);
    console.info(`predicted ms of voxels, fastest first: ${times.join(", ")}`);
    await client.page.screenshot({ path: join(screenshotFolder(), "slider-voxels-760.png") });
    // So dense that all are right, the fastest may well be the most accurate: the slider stays and says so.
    await client.after(async () => void (await samples.selectOption("Half a voxel apart")));
    await slider().blur();
    await slider().focus();
    await source("estimated");
    await saysWhyThereIsOne();
    await client.page.screenshot({ path: join(screenshotFolder(), "slider-dense-760.png") });
    await client.choose("demo:mesh");
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
