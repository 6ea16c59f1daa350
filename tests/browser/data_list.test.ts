import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { writeVoxels } from "./support/data";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp({
  data: (folder) => {
    // 0, 1 ... 15 along x, each as often: the mean is 7.5, the variance (256 - 1) / 12.
    const size = [16, 4, 5] as const;
    writeVoxels(folder, "steps", { size, spacing: [0.5, 1, 2], value: (x) => x });
  },
});
let client: Client;

beforeAll(async () => {
  client = await place.open();
});

const row = () => client.page.locator(".dataset").first();

/** A number that the details show beside its name. */
async function fact(name: string): Promise<string> {
  const line = row().locator(".facts > div").filter({ hasText: name }).first();
  return (await line.locator("dd").innerText()).trim();
}

describe("the list of data", () => {
  it("has a picture of each dataset, drawn by the server", async () => {
    const picture = row().locator(".thumbnail img");
    await picture.waitFor({ timeout: 60_000 });
    const colours = await picture.evaluate(async (img: HTMLImageElement) => {
      await img.decode();
      const canvas = new OffscreenCanvas(img.naturalWidth, img.naturalHeight);
      const context = canvas.getContext("2d");
      context?.drawImage(img, 0, 0);
      const { data = [] } = context?.getImageData(0, 0, canvas.width, canvas.height) ?? {};
      const seen = new Set<number>();
      for (let i = 0; i < data.length; i += 4) seen.add((data[i] ?? 0) >> 4);
      return { seen: seen.size, width: img.naturalWidth, height: img.naturalHeight };
    });
    expect(colours).toMatchObject({ width: 128, height: 96 });
    expect(colours.seen, "it shows something").toBeGreaterThan(3);
  });

  it("has statistics and the import's log", async () => {
    await row().locator("summary").click();
    await row().locator(".data-details").waitFor();
    expect(await fact("Voxels")).toBe("16 × 4 × 5");
    expect(await fact("Spacing")).toBe("0.5, 1, 2");
    expect(await fact("Type")).toBe("u8");
    expect(await fact("Smallest")).toBe("0");
    expect(await fact("Largest")).toBe("15");
    expect(Number(await fact("Mean"))).toBe(7.5);
    expect(Number(await fact("Standard deviation"))).toBeCloseTo(Math.sqrt(255 / 12), 4);
    expect(await fact("Values")).toBe("320");
    expect(await fact("Without value")).toBe("0 voxels");
    expect(await fact("Format")).toBe("MetaImage");
    expect(await fact("Took")).toMatch(/ms$/);
    expect(
      await row()
        .getByRole("img", { name: /Histogram/ })
        .count(),
    ).toBe(1);
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), "1280-data-details.png") });
    expect(client.complaints).toEqual([]);
  });
});

describe("a place that is kept", () => {
  it("stays in sight, follows the picture, and is copied as JSON", async () => {
    await client.page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await client.page.locator(".picture").focus();
    await client.page.keyboard.press("i");
    const line = client.page.locator(".picked");
    await line.getByText("voxel").waitFor();
    expect(await violations(client)).toEqual([]);
    await client.page.getByRole("button", { name: "Copy as JSON" }).click();
    await client.page.getByRole("button", { name: "Copied" }).waitFor();
    const copied = JSON.parse(await client.page.evaluate(() => navigator.clipboard.readText()));
    expect(copied).toMatchObject({ dataset: "steps.mhd", distance: expect.any(Number) });
    const [x = -1, y = -1, z = -1] = copied.voxel;
    expect([x, y, z].every(Number.isInteger)).toBe(true);
    // The value is that of the place: 0 to 15 over 7.5 world units of x.
    expect(copied.values[0].value).toBeCloseTo(copied.position[0] / 0.5, 4);
    const before = await line.innerText();
    await client.page.locator(".picture").focus();
    await client.after(() => client.page.keyboard.press("Shift+ArrowLeft"));
    await expect.poll(() => line.innerText(), { timeout: 20_000 }).not.toBe(before);
    await client.page.locator(".picture").focus();
    await client.page.keyboard.press("i");
    await line.waitFor({ state: "detached" });
  });

  it("is kept by a tap, where nothing can rest", async () => {
    const options = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
    const phone = await place.open(options);
    const { x, y } = await phone.middle();
    await phone.page.touchscreen.tap(x, y);
    await phone.page.locator(".picked").getByText("voxel").waitFor();
    expect(await violations(phone)).toEqual([]);
    await phone.page.screenshot({ path: join(screenshotFolder(), "390-pinned.png") });
    await phone.page.getByRole("button", { name: "Let the place go" }).tap();
    await phone.page.locator(".picked").waitFor({ state: "detached" });
    await phone.close();
  });
});
