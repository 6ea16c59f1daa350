import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { countColours } from "./support/pixels";
import { setUp } from "./support/set_up";

const kSide = 12;

const place = setUp({ data: writeData });
let client: Client;

/** A ball of falling values; the file before it in the list is cut short. */
function writeData(folder: string): void {
  const header = [
    "ObjectType = Image",
    "NDims = 3",
    `DimSize = ${kSide} ${kSide} ${kSide}`,
    "ElementType = MET_UCHAR",
    "ElementDataFile = ball.raw",
  ];
  writeFileSync(join(folder, "ball.mhd"), `${header.join("\n")}\n`);
  const voxels = new Uint8Array(kSide ** 3);
  const middle = (kSide - 1) / 2;
  for (let i = 0; i < voxels.length; i += 1) {
    const x = (i % kSide) - middle;
    const y = (Math.floor(i / kSide) % kSide) - middle;
    const z = Math.floor(i / kSide ** 2) - middle;
    voxels[i] = Math.max(0, 255 - 42 * Math.hypot(x, y, z));
  }
  writeFileSync(join(folder, "ball.raw"), voxels);
  writeFileSync(join(folder, "a_broken.vtu"), '<?xml version="1.0"?><VTKFile type="Unstruct');
}

beforeAll(async () => {
  client = await place.visit();
});

const row = (id: string) => client.page.locator(`.dataset[data-dataset="${id}"]`);

describe("a folder with a broken file", () => {
  it("says in the list which file is broken, and why", async () => {
    const error = row("a_broken.vtu").locator(".dataset-error");
    await error.waitFor({ timeout: 60_000 });
    await expect.poll(() => error.textContent()).toContain("a_broken.vtu");
    await expect.poll(() => row("ball.mhd").count()).toBe(1);
  });

  it("shows the other file", async () => {
    await row("ball.mhd").locator(".dataset-choose").click();
    await client.settled();
    expect(countColours(await client.pixels(), 32)).toBe(32);
  });

  it("keeps what is shown when the broken one is asked for again", async () => {
    const view = await client.fact("view");
    await row("a_broken.vtu").locator(".dataset-choose").click();
    const failed = client.page.locator(".notice", { hasText: "a_broken.vtu" });
    await failed.first().waitFor({ timeout: 60_000 });
    await client.waitForBadge("final");
    expect(await client.fact("view")).toBe(view);
    await client.after(() => client.drag(60, 20));
    expect(client.complaints).toEqual([]);
  });
});
