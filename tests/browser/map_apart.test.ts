import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { difference, hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 900 } });
  await client.choose("demo:volume");
  const volume = client.page.getByRole("radio", { name: /^Volume/ });
  if (!(await volume.isChecked())) await client.after(() => volume.check({ force: true }));
});

const picture = async (): Promise<string> => hashOf(await client.pixels());
const points = (kind: "Colour" | "Opacity") =>
  client.page.getByRole("button", { name: new RegExp(`^${kind} point \\d`) });
const apart = () =>
  client.page.getByRole("checkbox", { name: "Colour and opacity have points of their own" });

async function drag(kind: "Colour" | "Opacity", index: number, dx: number, dy: number) {
  const box = await points(kind).nth(index).boundingBox();
  if (!box) throw new Error("the point has no box");
  await client.page.mouse.move(box.x + 12, box.y + 12);
  await client.page.mouse.down();
  await client.page.mouse.move(box.x + 12 + dx, box.y + 12 + dy, { steps: 4 });
  await client.page.mouse.up();
}

describe("a map whose colours and opacities are edited apart", () => {
  it("has points of each kind, whatever the other has, and shows both", async () => {
    const before = await client.pixels();
    await client.after(() => apart().check());
    expect(difference(before, await client.pixels()).largest).toBe(0);
    const colours = await points("Colour").count();
    const opacities = await points("Opacity").count();
    expect(colours).not.toBe(opacities);

    const ground = await client.page.locator(".map-ground").boundingBox();
    if (!ground) throw new Error("the editor has no ground");
    const add = (y: number) =>
      client.after(() => client.page.mouse.dblclick(ground.x + 0.37 * ground.width, ground.y + y));
    await add(ground.height - 6);
    await expect.poll(() => points("Colour").count()).toBe(colours + 1);
    await expect.poll(() => points("Opacity").count()).toBe(opacities);
    await add(6);
    await expect.poll(() => points("Opacity").count()).toBe(opacities + 1);
    expect(difference(before, await client.pixels()).largest).toBeLessThanOrEqual(1);

    const seen = new Set([await picture()]);
    await client.after(() => drag("Opacity", 1, 10, -50));
    seen.add(await picture());
    const place = await points("Colour").nth(1).boundingBox();
    await client.after(() => drag("Opacity", 1, 10, 10));
    expect(await points("Colour").nth(1).boundingBox(), "colours stay").toEqual(place);
    await client.after(() => points("Colour").nth(1).press("ArrowRight"));
    seen.add(await picture());
    await client.after(() => client.page.getByLabel("Colour", { exact: true }).fill("#ff0000"));
    seen.add(await picture());
    expect(seen.size).toBe(4);
    expect(client.complaints).toEqual([]);
  });

  it("stays apart over a reload, and is one map again with the same picture", async () => {
    const before = await picture();
    const colours = await points("Colour").count();
    await client.page.reload();
    await client.settled();
    await expect.poll(() => points("Colour").count()).toBe(colours);
    expect(await picture()).toBe(before);
    await client.after(() => apart().uncheck());
    await expect.poll(() => points("Colour").count()).toBe(0);
    expect(await picture()).toBe(before);
    expect(client.complaints).toEqual([]);
  });
});

describe("a smooth curve of opacities", () => {
  const smooth = () => client.page.getByRole("checkbox", { name: /^Smooth opacity/ });
  const chosen = () => points("Opacity").and(client.page.locator('[aria-pressed="true"]'));

  it("has points of its own, and one that is added leaves the picture as it is to the bit", async () => {
    await client.after(() => client.page.getByRole("button", { name: "Start over" }).click());
    await client.after(() => smooth().check());
    expect(await apart().isChecked()).toBe(true);
    expect(await apart().isDisabled()).toBe(true);
    await client.page.locator(".map-plot").scrollIntoViewIfNeeded();
    await client.after(() => drag("Opacity", 2, 0, -60));
    await client.after(() => drag("Opacity", 3, 0, 50));
    const before = await client.pixels();
    const bent = await picture();
    const count = await points("Opacity").count();
    const colours = await points("Colour").count();
    const ground = await client.page.locator(".map-ground").boundingBox();
    if (!ground) throw new Error("the editor has no ground");
    for (const [i, x] of [0.12, 0.4, 0.6, 0.87].entries()) {
      const place = [ground.x + x * ground.width, ground.y + 8] as const;
      await client.after(() => client.page.mouse.click(...place));
      expect(await points("Opacity").count()).toBe(count + i + 1);
      const added = await chosen().boundingBox();
      expect(Math.abs((added?.x ?? 0) + (added?.width ?? 0) / 2 - place[0])).toBeLessThan(6);
      expect(difference(before, await client.pixels()).largest).toBe(0);
    }
    expect(await points("Colour").count()).toBe(colours);
    await client.page
      .locator(".map-plot")
      .screenshot({ path: join(screenshotFolder(), "map-smooth.png") });

    await client.after(() => chosen().press("Delete"));
    expect(await points("Opacity").count()).toBe(count + 3);
    expect(await picture()).toBe(bent);
    await client.after(() => drag("Opacity", 4, 0, -15));
    const moved = await picture();
    expect(moved).not.toBe(bent);
    await client.page.reload();
    await client.settled();
    await client.page.locator(".map-plot").scrollIntoViewIfNeeded();
    expect(await picture()).toBe(moved);
    expect(await points("Opacity").count()).toBe(count + 3);
    await client.after(() => smooth().uncheck());
    expect(await apart().isDisabled()).toBe(false);
    expect(client.complaints).toEqual([]);
  });
});
