import { join } from "node:path";
import type { Locator } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({
    viewport: { width: 1000, height: 800 },
    hasTouch: true,
  });
});

const handles = () => client.page.locator(".clip-handle");
const handle = (name: string) => client.page.getByRole("slider", { name, exact: true });
const picture = async (): Promise<string> => hashOf(await client.pixels());
const value = async (of: Locator): Promise<number> =>
  Number(await of.getAttribute("aria-valuenow"));

async function middleOf(of: Locator): Promise<{ x: number; y: number }> {
  const box = await of.boundingBox();
  if (!box) throw new Error("the handle has no box");
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** By one finger, sideways. */
async function drag(from: { x: number; y: number }, way: readonly number[]): Promise<void> {
  const touch = await client.page.context().newCDPSession(client.page);
  const send = (type: "touchStart" | "touchMove" | "touchEnd", dx?: number): Promise<unknown> =>
    touch.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: dx === undefined ? [] : [{ x: from.x + dx, y: from.y }],
    });
  await send("touchStart", 0);
  for (const dx of way) await send("touchMove", dx);
  await send("touchEnd");
  await touch.detach();
}

const undo = () => client.page.getByRole("button", { name: "Undo" }).click();

describe("a clip plane's handle", () => {
  const plane = () => handle("Clip plane 1, X");

  it("is there with its plane, and moves it under the mouse, as one step", async () => {
    await expect.poll(() => handles().count()).toBe(0);
    await client.after(() => client.page.getByRole("button", { name: "Add a clip plane" }).click());
    const before = await picture();
    const place = await value(plane());
    const from = await middleOf(plane());
    await client.after(async () => {
      await client.page.mouse.move(from.x + 5, from.y + 3);
      await client.page.mouse.down();
      await client.page.mouse.move(from.x + 45, from.y + 3, { steps: 8 });
      await client.page.mouse.up();
    });
    expect(await value(plane())).not.toBeCloseTo(place, 3);
    expect(await picture()).not.toBe(before);
    const at = await middleOf(plane());
    // It goes along its axis only; what was taken beside its middle stays beside it.
    expect(Math.abs(at.x - (from.x + 40))).toBeLessThan(3);
    await client.after(undo);
    expect(await value(plane())).toBe(place);
    expect(await picture()).toBe(before);
    expect(await violations(client)).toEqual([]);
  });

  it("moves by the arrow keys, in small steps with Shift, and not the camera", async () => {
    const before = await picture();
    const place = await value(plane());
    await plane().focus();
    await client.after(() => client.page.keyboard.press("ArrowUp"));
    const large = (await value(plane())) - place;
    expect(large).toBeGreaterThan(0);
    expect(await picture()).not.toBe(before);
    await plane().focus(); // Reading pixels hides what lies over them, and with it the focus.
    await client.after(() => client.page.keyboard.press("Shift+ArrowDown"));
    expect(place + large - (await value(plane()))).toBeCloseTo(large / 10, 6);
    expect(await plane().evaluate((e) => e === document.activeElement)).toBe(true);
    await client.after(undo); // Where the focus left, a step ended: there are two.
    await client.after(undo);
    expect(await picture()).toBe(before);
  });

  it("moves by touch", async () => {
    const place = await value(plane());
    const from = await middleOf(plane());
    await client.after(() => drag(from, [-10, -20, -30]));
    expect(await value(plane())).not.toBeCloseTo(place, 3);
    await client.after(undo);
  });

  it("removes its plane", async () => {
    await plane().focus();
    await client.after(() => client.page.keyboard.press("Delete"));
    await expect.poll(() => handles().count()).toBe(0);
  });
});

describe("a clip box", () => {
  it("has a handle on each face", async () => {
    const whole = await picture();
    await client.after(() => client.page.getByRole("button", { name: "Clip to a box" }).click());
    await expect.poll(() => handles().count()).toBe(7); // And one in its middle.
    expect(await picture()).not.toBe(whole);
    const face = handle("Clip plane 6, Z");
    const before = await picture();
    const from = await middleOf(face);
    await client.after(async () => {
      await client.page.mouse.move(from.x, from.y);
      await client.page.mouse.down();
      await client.page.mouse.move(from.x, from.y + 60, { steps: 6 });
      await client.page.mouse.up();
    });
    expect(await picture()).not.toBe(before);
    await client.page.screenshot({ path: join(screenshotFolder(), "handles-1000.png") });
    expect(await violations(client)).toEqual([]);
  });

  const middle = () => client.page.getByRole("button", { name: /^Clip box, all of it/ });
  const places = async (): Promise<number[]> =>
    Promise.all((await client.page.getByRole("slider", { name: /^Clip plane/ }).all()).map(value));

  it("moves as a whole by touch, as one step", async () => {
    const before = await places();
    const from = await middleOf(middle());
    await client.after(() => drag(from, [2, 4, 6]));
    const moves = (await places()).map((x, i) => x - (before[i] ?? 0));
    expect(Math.max(...moves.map(Math.abs))).toBeGreaterThan(0);
    for (const i of [0, 2, 4]) expect(moves[i]).toBeCloseTo(moves[i + 1] ?? Number.NaN, 6);
    await client.after(undo);
    expect(await places()).toEqual(before);
  });

  it("moves as a whole by its middle, by mouse and by keys, as one step each", async () => {
    const before = await places();
    const shown = await picture();
    const from = await middleOf(middle());
    await client.after(async () => {
      await client.page.mouse.move(from.x, from.y);
      await client.page.mouse.down();
      await client.page.mouse.move(from.x + 6, from.y, { steps: 3 });
      await client.page.mouse.up();
    });
    expect(await picture()).not.toBe(shown);
    const after = await places();
    const moves = after.map((x, i) => x - (before[i] ?? 0));
    expect(Math.max(...moves.map(Math.abs))).toBeGreaterThan(0);
    // Faces of an axis go together: the box keeps its size.
    for (const i of [0, 2, 4]) expect(moves[i]).toBeCloseTo(moves[i + 1] ?? Number.NaN, 6);
    await client.after(undo);
    expect(await places()).toEqual(before);
    await middle().focus();
    await client.after(() => client.page.keyboard.press("ArrowDown"));
    expect(await places()).not.toEqual(before);
    expect(await middle().evaluate((e) => e === document.activeElement)).toBe(true);
    await client.after(undo);
    expect(await picture()).toBe(shown);
    expect(await violations(client)).toEqual([]);
  });

  it.each([
    ["1280", { width: 1280, height: 800 }],
    ["390", { width: 390, height: 844 }],
  ])("fits %s pixels", async (name, size) => {
    await client.after(() => client.page.setViewportSize(size));
    await client.page.screenshot({ path: join(screenshotFolder(), `handles-${name}.png`) });
    expect(await violations(client)).toEqual([]);
  });

  it("has no handles where they are not wanted, and goes as a whole", async () => {
    await client.after(() => client.page.setViewportSize({ width: 1000, height: 800 }));
    await client.page.getByRole("button", { name: "View", exact: true }).click();
    await client.page.getByLabel("Handles of clip planes").uncheck();
    await expect.poll(() => handles().count()).toBe(0);
    await client.page.getByLabel("Handles of clip planes").check();
    await client.page.keyboard.press("Escape");
    await client.after(() => client.page.getByRole("button", { name: "Remove all" }).click());
    await expect.poll(() => handles().count()).toBe(0);
    expect(client.complaints).toEqual([]);
  });
});
