import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 1100, height: 800 } });
});

/** On the data: the middle of the demo's plate is a hole. */
async function onData(): Promise<{ x: number; y: number }> {
  const { x, y } = await client.middle();
  return { x: x - 150, y };
}

describe("a pointer that rests", () => {
  it("is told what the picture shows there", async () => {
    const { x, y } = await onData();
    await client.page.mouse.move(x, y);
    const line = client.page.locator(".picked");
    await line.waitFor();
    const text = await line.innerText();
    expect(text).toMatch(/-?\d/);
    expect(text).toContain("at ");
    expect(text).toMatch(/cell \d+|voxel \d+, \d+, \d+/);
    expect(client.complaints).toEqual([]);
  });

  it("is told nothing beside the data", async () => {
    const box = await client.page.locator(".picture").boundingBox();
    if (!box) throw new Error("the picture has no box");
    await client.page.mouse.move(box.x + 3, box.y + box.height / 2);
    await client.page.locator(".picked").waitFor({ state: "detached" });
  });

  it("is told nothing while it drags, and again when it rests", async () => {
    const { x, y } = await onData();
    const line = client.page.locator(".picked");
    await client.page.mouse.move(x, y);
    await line.waitFor();
    await client.page.mouse.down();
    await line.waitFor({ state: "detached" });
    await client.page.mouse.move(x + 30, y + 10, { steps: 5 });
    await expect.poll(() => line.count()).toBe(0);
    await client.page.mouse.up();
    await client.page.mouse.move(x, y);
    await line.waitFor();
  });
});

describe("the map's range", () => {
  it("follows percentiles, and numbers that are typed", async () => {
    const from = client.page.getByLabel("From", { exact: true });
    const before = await from.inputValue();
    await client.page.getByLabel("Low %").fill("20");
    await client.page.getByLabel("Low %").press("Enter");
    await client.after(() => client.page.getByRole("button", { name: "Auto range" }).click());
    await expect.poll(() => from.inputValue()).not.toBe(before);
    await client.after(async () => {
      await from.fill(before);
      await from.press("Enter");
    });
    expect(Number(await from.inputValue())).toBeCloseTo(Number(before), 5);
  });
});
