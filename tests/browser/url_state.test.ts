import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { Server } from "./support/server";
import { setUp } from "./support/set_up";

const kSize = { viewport: { width: 760, height: 480 } };

const place = setUp({ page: kSize });

const open = (url = place.url): Promise<Client> => place.open({}, url);

const picture = async (client: Client): Promise<string> => hashOf(await client.pixels());

const entries = ({ page }: Client): Promise<number> => page.evaluate(() => history.length);

/** Does something and waits until the address says so. */
async function untilAddressed(client: Client, act: () => Promise<void>): Promise<void> {
  const before = client.page.url();
  await act();
  await client.page.waitForFunction((url) => location.href !== url, before);
}

async function model(client: Client, name: string): Promise<void> {
  const radio = client.page.getByRole("radio", { name, exact: true });
  await client.after(() => untilAddressed(client, () => radio.check({ force: true })));
}

describe("the address", () => {
  it("opens the same picture for somebody else", async () => {
    const client = await open();
    await client.page.waitForURL(/#view=z[\w-]+$/);
    await model(client, "Maximum");
    await client.after(() => untilAddressed(client, () => client.drag(90, -30)));
    const url = client.page.url();
    console.info(`a view with its camera and map: an address of ${url.length} letters`);
    const other = await open(url);
    expect(await picture(other)).toBe(await picture(client));
    await expect
      .poll(() => other.page.getByRole("radio", { name: "Maximum" }).isChecked())
      .toBe(true);
    await other.after(() => other.page.keyboard.press("r"));
    await client.after(() => client.page.keyboard.press("r"));
    expect(await picture(other)).toBe(await picture(client));
  });

  it("goes back and forward over what was done, and not over each move", async () => {
    const client = await open();
    await client.page.waitForURL(/#view=/);
    await model(client, "Maximum");
    await client.after(() => untilAddressed(client, () => client.drag(60, 0)));
    const maximum = await picture(client);
    const before = await entries(client);
    await client.after(() => untilAddressed(client, () => client.drag(0, 30)));
    await client.after(() => untilAddressed(client, () => client.drag(0, -30)));
    expect(await entries(client)).toBe(before);
    const moved = await picture(client);
    await model(client, "Surface");
    expect(await entries(client)).toBe(before + 1);
    const surface = await picture(client);
    await client.after(async () => void (await client.page.goBack()));
    expect(await picture(client)).toBe(moved);
    await expect
      .poll(() => client.page.getByRole("radio", { name: "Maximum" }).isChecked())
      .toBe(true);
    await client.after(async () => void (await client.page.goForward()));
    expect(await picture(client)).toBe(surface);
    await client.after(() => client.page.getByRole("button", { name: "Undo" }).click());
    expect(maximum).not.toBe(surface);
  });

  it("goes back to data that was left", async () => {
    const client = await open();
    await client.page.waitForURL(/#view=/);
    await client.after(() => untilAddressed(client, () => client.drag(50, 20)));
    const before = await picture(client);
    const row = client.page.locator(".dataset:not([data-shown])").first();
    await client.after(() => untilAddressed(client, () => row.locator(".dataset-choose").click()));
    const other = await picture(client);
    expect(other).not.toBe(before);
    await client.after(async () => void (await client.page.goBack()));
    expect(await picture(client)).toBe(before);
    await client.after(async () => void (await client.page.goForward()));
    expect(await picture(client)).toBe(other);
  });

  it("may be a link, which is joined in its place and left by going back", async () => {
    const ann = await open();
    await ann.after(() => ann.drag(40, 40));
    await ann.page.getByRole("button", { name: "Share", exact: true }).click();
    await ann.page.getByRole("button", { name: "Make a link" }).click();
    const link = await ann.page.getByRole("textbox", { name: "Link to watch" }).inputValue();
    const ben = await open();
    await ben.page.waitForURL(/#view=/);
    const own = await picture(ben);
    await ben.page.evaluate((hash) => {
      location.hash = hash;
    }, new URL(link).hash);
    await ben.watched();
    expect(await picture(ben)).not.toBe(own);
    await ben.page.goBack();
    await ben.settled();
    expect(await picture(ben)).toBe(own);
    await ben.after(() => ben.drag(20, 0));
  });

  it("that cannot be read is said, and so is data that is not there", async () => {
    const odd = await open(`${place.url}#view=zAAAA`);
    await odd.page.locator(".notice", { hasText: "cannot be read" }).waitFor();
    const client = await open();
    await client.page.waitForURL(/#view=/);
    const data = await Server.start({ data: mkdtempSync(join(tmpdir(), "volcast-empty-")) });
    const lost = await place.visit({}, client.page.url().replace(place.url, data.url));
    await lost.page.locator(".notice").first().waitFor();
    await lost.close();
    await data.stop();
  });

  it("of a page that is loaded again says what was done a moment ago", async () => {
    const client = await open();
    await client.after(() => client.drag(33, 44));
    const dragged = await picture(client);
    await client.page.keyboard.press("ArrowLeft");
    await client.page.reload();
    await client.settled();
    const reloaded = await picture(client);
    expect(reloaded).not.toBe(dragged);
    await client.page.waitForURL(/#view=/);
    await client.after(() =>
      untilAddressed(client, () => client.page.keyboard.press("ArrowRight")),
    );
    expect(await picture(client)).toBe(dragged);
    await client.after(() => client.page.keyboard.press("ArrowLeft"));
    expect(await picture(client)).toBe(reloaded);
  });
});

describe("a saved scene", () => {
  let folder: string;
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), "volcast-scene-"));
  });
  afterAll(() => rmSync(folder, { recursive: true, force: true }));

  const share = ({ page }: Client): Promise<void> =>
    page.getByRole("button", { name: "Share", exact: true }).click();

  async function load(client: Client, path: string): Promise<void> {
    await share(client);
    await client.page.getByRole("button", { name: "Load a scene" }).waitFor();
    await client.page.locator('input[type="file"]').setInputFiles(path);
    await client.page.keyboard.press("Escape");
  }

  it("is read by the server's names, and shows the same picture again", async () => {
    const client = await open();
    await model(client, "Maximum");
    await client.after(() => client.drag(-70, 35));
    const before = await picture(client);
    await share(client);
    const download = client.page.waitForEvent("download");
    await client.page.getByRole("button", { name: "Save the scene" }).click();
    const path = join(folder, "scene.json");
    await (await download).saveAs(path);
    const scene = JSON.parse(readFileSync(path, "utf8"));
    expect(scene.layers[0].model).toBe("RAY_MODEL_MIP");
    expect(scene.camera.eye).toHaveProperty("x");
    const other = await open();
    await other.after(() => load(other, path));
    expect(await picture(other)).toBe(before);
    await other.after(() => other.drag(10, 0));
    expect(await picture(other)).not.toBe(before);
  });

  it("brings back how its map was edited, as the address does", async () => {
    const client = await open();
    await client.after(() => client.page.getByLabel(/^Smooth opacity/).check());
    await client.page.locator(".map-ground").scrollIntoViewIfNeeded();
    const ground = await client.page.locator(".map-ground").boundingBox();
    await client.after(() =>
      client.page.mouse.click((ground?.x ?? 0) + 0.4 * (ground?.width ?? 0), (ground?.y ?? 0) + 8),
    );
    const added = client.page.getByRole("button", { name: /^Opacity point 3 of/ });
    await client.after(() => added.press("ArrowUp"));
    await client.after(() =>
      untilAddressed(client, () =>
        client.page.getByRole("slider", { name: /^Density/ }).fill("0.5"),
      ),
    );
    const count = await client.page.locator(".map-point").count();
    const before = await picture(client);
    await share(client);
    const download = client.page.waitForEvent("download");
    await client.page.getByRole("button", { name: "Save the scene" }).click();
    const path = join(folder, "edited.json");
    await (await download).saveAs(path);
    const other = await open();
    await other.after(() => load(other, path));
    for (const one of [other, await open(client.page.url())]) {
      expect(await picture(one)).toBe(before);
      expect(await one.page.getByLabel(/^Smooth opacity/).isChecked()).toBe(true);
      expect(await one.page.getByRole("slider", { name: /^Density/ }).inputValue()).toBe("0.5");
      expect(await one.page.locator(".map-point").count()).toBe(count);
    }
  });

  it("that is none is refused with the reason, and nothing changes", async () => {
    const client = await open();
    const before = await picture(client);
    const path = join(folder, "odd.json");
    writeFileSync(path, '{"layerz": []}');
    await load(client, path);
    await client.page.locator(".notice", { hasText: /odd\.json is no scene: .*layerz/ }).waitFor();
    const point = { value: 0, colour: { r: 1 }, extinction: 1 };
    const layer = { id: "a", dataset: "nowhere", transferFunction: { points: [point] } };
    const camera = { eye: { x: 3 }, center: {}, up: { z: 1 }, fovyDegrees: 30 };
    writeFileSync(path, JSON.stringify({ camera, layers: [layer] }));
    await load(client, path);
    await client.page.locator(".notice", { hasText: "nowhere" }).waitFor();
    await client.settled();
    expect(await picture(client)).toBe(before);
  });
});
