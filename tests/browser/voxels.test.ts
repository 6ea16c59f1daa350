import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 400 } });
  await client.choose("demo:volume");
});

const picture = async (): Promise<string> => hashOf(await client.pixels());

async function choose(name: string, label: string): Promise<void> {
  await client.page.getByRole("combobox", { name, exact: true }).selectOption({ label });
}

async function type(name: string, text: string): Promise<void> {
  const input = client.page.getByRole("textbox", { name, exact: true });
  await input.fill(text);
  await input.press("Enter");
}

const slide = (name: string, to: string): Promise<void> =>
  client.page.getByRole("slider", { name, exact: true }).fill(to);

const check = (name: string, on: boolean): Promise<void> =>
  client.page.getByRole("checkbox", { name, exact: true }).setChecked(on);

/** Makes every step, and expects that each shows another picture. */
async function expectEachDiffers(steps: readonly (() => Promise<void>)[]): Promise<void> {
  const seen = new Set([await picture()]);
  for (const step of steps) {
    await client.after(step);
    seen.add(await picture());
  }
  expect(seen.size).toBe(steps.length + 1);
}

describe("a volume of voxels", () => {
  it("is sampled as the panel says", async () => {
    await expectEachDiffers([
      () => choose("Between voxels", "Nearest voxel"),
      () => choose("Between voxels", "Cubic"),
      () => choose("Samples", "By their number"),
      () => type("Samples over the depth", "20"),
      () => slide("Gain", "0.55"),
    ]);
    expect(client.complaints).toEqual([]);
  });

  it("is jittered by a seed, sliced, and sampled 64 times over its depth", async () => {
    await client.after(() => choose("Samples", "Half a voxel apart"));
    await client.after(() => choose("Between voxels", "Linear"));
    const plain = await picture();
    await expectEachDiffers([
      () => check("Jitter: noise instead of bands", true),
      () => type("Seed", "7"),
    ]);
    await client.after(() => check("Jitter: noise instead of bands", false));
    expect(await picture()).toBe(plain);
    await expectEachDiffers([
      () => choose("Drawn by", "Slices across the view"),
      () => choose("Samples", "By their number"),
    ]);
    const samples = client.page.getByRole("textbox", { name: "Samples over the depth" });
    await expect.poll(() => samples.inputValue()).toBe("64");
    await client.after(() => choose("Drawn by", "Whatever is faster"));
    await client.after(() => choose("Samples", "Half a voxel apart"));
    expect(await picture()).toBe(plain);
  });

  it("is as accurate as is wished, with a bound where that needs one", async () => {
    await client.after(() => choose("Wish", "Fastest"));
    const fastest = await picture();
    await expectEachDiffers([() => choose("Wish", "Exact")]);
    await client.after(() => choose("Wish", "Error at most"));
    await client.after(() => type("Error, in 1/255", "0.5"));
    await client.after(() => choose("Wish", "Time at most"));
    await client.after(() => type("Time, ms a picture", "2000"));
    await expect.poll(() => client.page.locator(".refusal").count()).toBe(0);
    await client.after(() => choose("Wish", "Fastest"));
    expect(await picture()).toBe(fastest);
    await client.after(() => choose("Wish", "Automatic"));
  });

  it("is drawn by every integrator that is offered", async () => {
    const choice = client.page.getByRole("combobox", { name: "Integrator", exact: true });
    const labels = await choice.locator("option").allTextContents();
    expect(labels).toHaveLength(7);
    for (const label of labels.slice(1)) await client.after(() => choose("Integrator", label));
    await expect.poll(() => client.page.locator(".refusal").count()).toBe(0);
    await client.after(() => choose("Integrator", "As the wish asks"));
  });

  it("is lit from the eye and from a point", async () => {
    const dark = await picture();
    await expectEachDiffers([
      () => check("Light", true),
      () => slide("Ambient", "0.6"),
      () => slide("Diffuse", "0.2"),
      () => slide("Specular", "0.9"),
      () => slide("Shininess", "0.05"),
      () => choose("Light from", "A point"),
      () => type("Light X", "-100"),
    ]);
    await client.after(() => check("Light", false));
    expect(await picture()).toBe(dark);
  });

  it("is cut by planes that are moved and hidden", async () => {
    const radio = client.page.getByRole("radio", { name: /^Sections/ });
    await expectEachDiffers([
      () => radio.check({ force: true }),
      () => slide("At X", "0.4"),
      () => slide("At Z", "0.7"),
      () => check("Y", false),
      () => check("X", false),
    ]);
    await expect.poll(() => client.page.getByRole("slider", { name: "At X" }).count()).toBe(0);
    expect(client.complaints).toEqual([]);
  });
});
