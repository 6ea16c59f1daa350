import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;
const kComparedMs = 120_000;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 420 } });
  await client.choose("demo:mesh");
  const slider = client.page.getByRole("slider", { name: "From fastest to exact" });
  await slider.waitFor();
  await client.after(() => slider.press("Home"));
});

const canvas = () => client.page.locator(".difference-picture");
const done = () =>
  client.page.waitForSelector('.difference-picture[data-done][data-step="1"]', {
    timeout: kComparedMs,
  });
const figure = async (name: string): Promise<number> => {
  const text = await client.page.locator(`[data-figure="${name}"]`).textContent();
  return Number.parseFloat((text ?? "").replaceAll(",", ""));
};

interface Counted {
  readonly unknown: number;
  readonly black: number;
  readonly brightest: number;
}

/** Of the canvas itself: pixels that are not known, that are black, and how bright the others get. */
const count = (): Promise<Counted> =>
  canvas().evaluate((element) => {
    const { width, height } = element as HTMLCanvasElement;
    const context = (element as HTMLCanvasElement).getContext("2d");
    const { data } = context?.getImageData(0, 0, width, height) ?? { data: [] };
    let unknown = 0;
    let black = 0;
    let brightest = 0;
    for (let i = 0; i < data.length; i += 4) {
      const sum = (data[i] ?? 0) + (data[i + 1] ?? 0) + (data[i + 2] ?? 0);
      if (data[i + 3] === 0) unknown += 1;
      else if (sum < 12) black += 1;
      brightest = Math.max(brightest, sum);
    }
    return { unknown, black, brightest };
  });

describe("the difference from the reference", () => {
  it("is shown over the picture, every pixel of it, with its figures", async () => {
    await client.page.getByRole("button", { name: "Show the difference" }).click();
    await done();
    const size = (await client.fact("size")).split("x").map(Number);
    const thousands = Math.round(((size[0] ?? 0) * (size[1] ?? 0)) / 1000);
    await expect
      .poll(() => client.page.locator('[data-figure="pixels"]').textContent())
      .toBe(`${thousands} k`);
    const largest = await figure("max");
    expect(largest).toBeGreaterThan(1);
    expect(await figure("rms")).toBeLessThan(largest);
    expect(await figure("share")).toBeGreaterThan(0);
    const { unknown, black, brightest } = await count();
    expect(unknown).toBe(0);
    expect(black).toBeGreaterThan(1000);
    expect(brightest).toBeGreaterThan(300);
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), "difference-760.png") });
  });

  it("has a scale whose end can be moved", async () => {
    const end = client.page.getByRole("slider", { name: "Scale ends at" });
    const before = await count();
    await end.press("End");
    await expect.poll(() => end.getAttribute("aria-valuetext")).toBe("256 of 255");
    const after = await count();
    expect(after.black).toBeGreaterThan(before.black);
    await end.fill("2");
    expect((await count()).black).toBe(before.black);
  });

  it("goes while the view moves, and comes back for the exact picture", async () => {
    await client.after(() => client.page.locator(".picture").press("ArrowRight"));
    await done();
    const rough = await figure("max");
    const slider = client.page.getByRole("slider", { name: "From fastest to exact" });
    await client.after(() => slider.press("End"));
    await done();
    expect(await figure("max")).toBeLessThan(rough);
  });

  it.each([
    ["1280", { width: 1280, height: 720 }],
    ["390", { width: 390, height: 844 }],
  ])("fits %s pixels", async (name, size) => {
    await client.after(() => client.page.setViewportSize(size));
    await canvas().waitFor({ timeout: kComparedMs });
    await client.page.waitForSelector('[data-figure="max"]');
    await client.page.screenshot({ path: join(screenshotFolder(), `difference-${name}.png`) });
    expect(await violations(client)).toEqual([]);
  });

  it("has a legend that leaves a narrow picture to be seen, and more of it on request", async () => {
    await client.page.locator(".difference-legend .icon-button").click();
    const show = client.page.getByRole("button", { name: "Show the difference" });
    if (!(await show.isVisible())) {
      await client.after(() => client.page.locator(".sheet-toggle").click());
    }
    await show.click();
    await done();
    const figures = client.page.locator(".difference-figures");
    expect(await figures.isVisible()).toBe(false);
    const legend = await client.page.locator(".difference-legend").boundingBox();
    const picture = await client.page.locator(".picture").boundingBox();
    expect(legend?.height).toBeLessThan((picture?.height ?? 0) / 3);
    await client.page.screenshot({ path: join(screenshotFolder(), "difference-390-strip.png") });
    await client.page.getByText("Scale and figures").click();
    expect(await figures.isVisible()).toBe(true);
    expect(await violations(client)).toEqual([]);
  });

  it("is hidden again", async () => {
    await client.page.locator(".difference-legend .icon-button").click();
    await expect.poll(() => client.page.locator(".difference").count()).toBe(0);
    expect(client.complaints).toEqual([]);
  });
});
