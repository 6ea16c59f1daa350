import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { setUp } from "./support/set_up";

const kSide = 16;

const place = setUp({ data: writeData });
let client: Client;

/** Two balls beside each other, one a channel. */
function writeData(folder: string): void {
  const header = [
    "ObjectType = Image",
    "NDims = 3",
    `DimSize = ${kSide} ${kSide} ${kSide}`,
    "ElementNumberOfChannels = 2",
    "ElementType = MET_UCHAR",
    "ElementDataFile = balls.raw",
  ];
  writeFileSync(join(folder, "balls.mhd"), `${header.join("\n")}\n`);
  const voxels = new Uint8Array(2 * kSide ** 3);
  for (let i = 0; i < kSide ** 3; i += 1) {
    const [x, y, z] = [i % kSide, Math.floor(i / kSide) % kSide, Math.floor(i / kSide ** 2)];
    const ball = (cx: number, cz: number): number =>
      Math.max(0, 255 - 50 * Math.hypot(x - cx, y - 7.5, z - cz));
    voxels[2 * i] = ball(4.5, 5.5);
    voxels[2 * i + 1] = ball(10.5, 10.5);
  }
  writeFileSync(join(folder, "balls.raw"), voxels);
}

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 900 } });
});

const picture = async (): Promise<string> => hashOf(await client.pixels());

describe("channels of a volume", () => {
  it("are drawn together, each with its own colour, and hidden one by one", async () => {
    const alone = await picture();
    const together = client.page.getByLabel("Draw channels together");
    await client.after(() => together.check());
    const both = await picture();
    const rows = client.page.locator(".channel");
    await expect.poll(() => rows.count()).toBe(2);
    await client.after(() => rows.nth(0).getByRole("checkbox", { name: "balls_0" }).uncheck());
    const second = await picture();
    await client.after(() => rows.nth(0).getByRole("checkbox", { name: "balls_0" }).check());
    expect(await picture()).toBe(both);
    await client.after(async () => {
      await rows.nth(1).getByLabel("Opacity %").fill("10");
      await rows.nth(1).getByLabel("Opacity %").press("Enter");
    });
    const faint = await picture();
    expect(new Set([alone, both, second, faint]).size).toBe(4);
    await client.after(() => together.uncheck());
    expect(await picture()).toBe(alone);
    expect(client.complaints).toEqual([]);
  });

  it("say their values under the pointer, the brighter one first", async () => {
    await client.after(() => client.page.getByLabel("Draw channels together").check());
    const { x, y } = await client.middle();
    await client.page.mouse.move(x, y);
    const line = client.page.locator(".picked");
    await line.waitFor();
    await expect.poll(() => line.innerText()).toMatch(/balls_0.*balls_1|balls_1.*balls_0/s);
  });
});
