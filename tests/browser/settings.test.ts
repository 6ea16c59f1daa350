import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { difference, hashOf } from "./support/pixels";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 900 } });
});

async function choose(dataset: string): Promise<void> {
  const row = client.page.locator(`.dataset[data-dataset="${dataset}"]`);
  if ((await row.getAttribute("data-shown")) !== null) return;
  await client.after(async () => {
    await row.locator(".dataset-choose").click();
    await row.and(client.page.locator("[data-shown]")).waitFor();
  });
}

async function model(name: string): Promise<void> {
  const radio = client.page.getByRole("radio", { name, exact: true });
  if (await radio.isChecked()) return;
  await client.after(() => radio.check({ force: true }));
}

async function picture(): Promise<string> {
  return hashOf(await client.pixels());
}

describe("ray models", () => {
  it("of a mesh draw different pictures", async () => {
    await choose("demo:mesh");
    const seen = new Set<string>();
    for (const name of ["Volume", "Maximum", "Surface"]) {
      await model(name);
      seen.add(await picture());
    }
    expect(seen.size).toBe(3);
  });

  it("have options that suit them", async () => {
    await choose("demo:mesh");
    await model("Surface");
    const lit = await picture();
    await client.after(() => client.page.getByLabel("Headlight").uncheck());
    const unlit = await picture();
    const coloured = client.page.getByLabel("Coloured by the field");
    await client.after(async () => {
      await coloured.setChecked(!(await coloured.isChecked()));
    });
    expect(new Set([lit, unlit, await picture()]).size).toBe(3);
    await model("Volume");
    await expect.poll(() => client.page.getByLabel("Headlight").count()).toBe(0);
  });

  it("of voxels are named ON and MAX", async () => {
    await choose("demo:volume");
    await model("Volume (ON)");
    const on = await picture();
    await model("Maximum (MAX)");
    expect(await picture()).not.toBe(on);
    await model("Volume (ON)");
    expect(await picture()).toBe(on);
  });
});

describe("data", () => {
  it("keeps the view of a dataset that one comes back to", async () => {
    await choose("demo:mesh");
    await client.after(() => client.drag(100, 20));
    const turned = await picture();
    await choose("demo:volume");
    expect(await picture()).not.toBe(turned);
    await choose("demo:mesh");
    expect(await picture()).toBe(turned);
  });
});

describe("transfer function", () => {
  const point = (index: number) => client.page.locator(`.map-point[data-index="${index}"]`);
  const points = () => client.page.locator(".map-point").count();

  beforeAll(async () => {
    await choose("demo:volume");
    await model("Volume (ON)");
  });

  it("changes the picture when a point is dragged, and undo brings it back", async () => {
    const before = await picture();
    const box = await point(1).boundingBox();
    if (!box) throw new Error("the second point has no box");
    await client.after(async () => {
      await client.page.mouse.move(box.x + 12, box.y + 12);
      await client.page.mouse.down();
      await client.page.mouse.move(box.x + 17, box.y - 28, { steps: 6 });
      await client.page.mouse.up();
    });
    expect(await picture()).not.toBe(before);
    await client.after(() => client.page.keyboard.press("Control+z"));
    expect(await picture()).toBe(before);
    await client.after(() => client.page.keyboard.press("Control+Shift+Z"));
    expect(await picture()).not.toBe(before);
    await client.after(() => client.page.keyboard.press("Control+z"));
  });

  it("gets a point by a double click without changing the picture by a bit, and loses it again", async () => {
    const count = await points();
    const before = await client.pixels();
    const ground = await client.page.locator(".map-ground").boundingBox();
    if (!ground) throw new Error("the editor has no box");
    await client.after(() =>
      client.page.mouse.dblclick(ground.x + 0.43 * ground.width, ground.y + 6),
    );
    expect(await points()).toBe(count + 1);
    expect(difference(before, await client.pixels()).largest).toBe(0);
    const added = client.page.locator('.map-point[aria-pressed="true"]');
    await client.after(() => added.press("Delete"));
    expect(await points()).toBe(count);
  });

  it("is edited with the keyboard alone", async () => {
    const before = await picture();
    await point(1).focus();
    await client.after(() => client.page.keyboard.press("ArrowUp"));
    const raised = await picture();
    expect(raised).not.toBe(before);
    await client.after(async () => {
      const opacity = client.page.getByLabel("Opacity %");
      await opacity.fill("90");
      await opacity.press("Enter");
    });
    expect(await picture()).not.toBe(raised);
    await expect.poll(() => client.page.getByLabel("Opacity %").inputValue()).toBe("90");
    await client.page.locator(".picture").focus();
    await client.after(() => client.page.keyboard.press("Control+z"));
    await client.after(() => client.page.keyboard.press("Control+z"));
    expect(await picture()).toBe(before);
  });

  it("takes colour maps, opacity curves and density", async () => {
    const seen = new Set([await picture()]);
    const steps = [
      () => client.page.getByRole("button", { name: "Inferno colours" }).click(),
      async () => {
        await client.page.getByLabel("Opacity curve").selectOption("even");
      },
      () => client.page.getByRole("slider", { name: "Density" }).fill("0.5"),
      () => client.page.getByRole("button", { name: "Start over" }).click(),
    ];
    for (const step of steps) {
      await client.after(step);
      seen.add(await picture());
    }
    expect(seen.size).toBe(steps.length + 1);
    expect(client.complaints).toEqual([]);
  });
});
