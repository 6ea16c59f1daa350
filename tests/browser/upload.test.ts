import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { writeBall } from "./support/data";
import { countColours } from "./support/pixels";
import { Server, screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

let mine: string;
const place = setUp({
  data: (folder) => writeBall(folder, "first", 8),
  more: ["--allow-uploads", "--max-upload-mb", "2", "--upload-keep-free-mb", "1"],
});
let client: Client;
let other: Client;

beforeAll(async () => {
  mine = mkdtempSync(join(tmpdir(), "volcast-mine-"));
  writeBall(mine, "ball", 12);
  client = await place.open();
  other = await place.open();
});

afterAll(() => rmSync(mine, { recursive: true, force: true }));

/** 4 x 4 pixels of grey in four steps. */
const kGreyPng =
  "iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAAAAACMmsGiAAAAHElEQVR4nGNgsKnYwsDl1rSPQSSg5wSDXNS0SwA5HAaR4OH8SgAAAABJRU5ErkJggg==";

const input = () => client.page.locator(".upload-input");
const row = (of: Client, id: string) => of.page.locator(`.dataset[data-dataset="${id}"]`);
const refusal = () => client.page.locator(".upload .dataset-error");

/** Drops files of these names and contents on the window, as a file manager does. */
async function drop(files: readonly (readonly [name: string, bytes: number])[]): Promise<void> {
  const transfer = await client.page.evaluateHandle((list) => {
    const data = new DataTransfer();
    for (const [name, bytes] of list) data.items.add(new File([new Uint8Array(bytes)], name));
    return data;
  }, files);
  for (const type of ["dragenter", "dragover"]) {
    await client.page.dispatchEvent("body", type, { dataTransfer: transfer });
  }
  await client.page.locator(".drop-zone").waitFor();
  await client.page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await client.page.locator(".drop-zone").waitFor({ state: "detached" });
}

describe("uploading", () => {
  it("shows the files of one dataset, and lists it for everybody", async () => {
    await client.after(async () => {
      await input().setInputFiles([join(mine, "ball.mhd"), join(mine, "ball.raw")]);
      await row(client, "uploads/ball/ball.mhd").and(client.page.locator("[data-shown]")).waitFor();
    });
    expect(countColours(await client.pixels(), 32)).toBe(32);
    await row(other, "uploads/ball/ball.mhd").waitFor();
    await expect.poll(() => client.page.locator(".upload").count()).toBe(0);
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), "1280-upload.png") });
  });

  it("says what the server cannot read, and leaves nothing there", async () => {
    await input().setInputFiles({ name: "letter.doc", mimeType: "", buffer: Buffer.from("Dear") });
    await refusal().waitFor();
    await expect
      .poll(() => refusal().innerText())
      .toMatch(/letter was not taken: none of the 1 files/);
    expect(await violations(client)).toEqual([]);
    await expect.poll(() => readdirSync(join(place.folder, "uploads"))).toEqual(["ball"]);
    await client.page.getByRole("button", { name: "Hide" }).click();
    await expect.poll(() => refusal().count()).toBe(0);
  });

  it("takes a drop anywhere on the window; what is too large or empty is not even sent", async () => {
    await drop([["large.raw", 3 << 20]]);
    await refusal().waitFor();
    await expect
      .poll(() => refusal().innerText())
      .toMatch(/3\.0 MB; this server takes 2\.0 MB at once/);
    await drop([["empty.vtu", 0]]);
    await expect.poll(() => refusal().innerText()).toMatch(/empty\.vtu is empty/);
    await drop([
      ["cut.mhd", 10],
      ["cut.raw", 10],
    ]);
    const error = row(client, "uploads/cut/cut.mhd").locator(".dataset-error");
    await error.waitFor({ timeout: 60_000 });
    await expect.poll(() => error.innerText()).toContain("cut.mhd");
    expect(client.complaints).toEqual([]);
  });

  it("can be cancelled, and shows how far it is", async () => {
    // A slow way: bytes of an upload pass, but not all at once.
    const devtools = await client.page.context().newCDPSession(client.page);
    await devtools.send("Network.enable");
    const slow = { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput: 50_000 };
    await devtools.send("Network.emulateNetworkConditions", slow);
    await input().setInputFiles({
      name: "long.vtu",
      mimeType: "",
      buffer: Buffer.alloc(1 << 20),
    });
    const bar = client.page.getByRole("progressbar", { name: "Uploading long" });
    await bar.waitFor();
    await expect
      .poll(() => bar.getAttribute("value").then(Number), { timeout: 30_000 })
      .toBeGreaterThan(0);
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), "1280-uploading.png") });
    await client.page.getByRole("button", { name: "Cancel" }).click();
    await client.page.locator(".upload").waitFor({ state: "detached" });
    const fast = { ...slow, uploadThroughput: -1 };
    await devtools.send("Network.emulateNetworkConditions", fast);
    await expect
      .poll(() => readdirSync(join(place.folder, "uploads")).filter((n) => n.startsWith(".")))
      .toEqual([]);
    expect(client.complaints).toEqual([]);
  });

  it("takes a stack of pictures as one dataset", async () => {
    const pictures = [1, 2, 3].map((i) => ({
      name: `slice_${i}.png`,
      mimeType: "image/png",
      buffer: Buffer.from(kGreyPng, "base64"),
    }));
    await client.after(async () => {
      await input().setInputFiles(pictures);
      await row(client, "uploads/slice").and(client.page.locator("[data-shown]")).waitFor();
    });
    await expect.poll(() => row(client, "uploads/slice").innerText()).toContain("× 3");
  });
});

describe("a server that takes no uploads", () => {
  it("offers none, and says so to who drops files", async () => {
    const plain = await Server.start();
    const visitor = await place.open({}, plain.url);
    await expect.poll(() => visitor.page.locator(".upload-button").count()).toBe(0);
    const transfer = await visitor.page.evaluateHandle(() => {
      const data = new DataTransfer();
      data.items.add(new File(["x"], "a.vtu"));
      return data;
    });
    for (const type of ["dragenter", "drop"]) {
      await visitor.page.dispatchEvent("body", type, { dataTransfer: transfer });
    }
    await visitor.page.locator(".notice", { hasText: "takes no uploads" }).waitFor();
    await visitor.close();
    await plain.stop();
  });
});
