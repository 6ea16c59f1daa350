import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { countColours, difference, hashOf } from "./support/pixels";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open();
});

describe("first frame", () => {
  it("is a picture of something, final and exact", async () => {
    expect(await client.fact("lossless")).toBe("true");
    expect(countColours(await client.pixels(), 64)).toBe(64);
    expect(client.complaints).toEqual([]);
  });

  it("has the size of its place in device pixels", async () => {
    const box = await client.page.locator(".picture canvas").boundingBox();
    expect(await client.fact("size")).toBe(`${box?.width}x${box?.height}`);
  });

  it("shows the server's lossless pixels and nothing else", async () => {
    expect(String(client.lossless?.header.inputSeq)).toBe(await client.fact("inputSeq"));
    expect(difference(await client.pixels(), await client.sent())).toEqual({
      largest: 0,
      pixels: 0,
    });
  });

  it("can be saved, byte by byte as the server made it", async () => {
    const download = client.page.waitForEvent("download");
    await client.page.getByRole("button", { name: "Save the picture" }).click();
    const stream = await (await download).createReadStream();
    const parts: Buffer[] = [];
    for await (const part of stream) parts.push(part as Buffer);
    const saved = Buffer.concat(parts);
    expect(saved.equals(Buffer.from(client.lossless?.payload ?? []))).toBe(true);
  });

  it("comes back after a reload with the camera where it was", async () => {
    await client.after(() => client.drag(120, 40));
    const before = hashOf(await client.pixels());
    await client.page.reload();
    await client.settled();
    expect(hashOf(await client.pixels())).toBe(before);
  });
});
