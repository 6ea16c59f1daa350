import { join } from "node:path";
import { beforeAll, beforeEach, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { hashOf, type Pixels } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;
let home: string;

const picture = async (): Promise<string> => hashOf(await client.pixels());
const press = (key: string): Promise<void> => client.after(() => client.page.keyboard.press(key));
const menu = () => client.page.getByRole("button", { name: "View", exact: true });

beforeAll(async () => {
  client = await place.open({ viewport: { width: 860, height: 420 } });
  await client.after(() =>
    client.page.getByRole("radio", { name: "Surface", exact: true }).check({ force: true }),
  );
  home = await picture();
});

/** Every test starts from the first camera, with the picture focused. */
beforeEach(async () => {
  await client.page.locator(".picture").focus();
  if ((await picture()) === home) return;
  await press("r");
  expect(await picture()).toBe(home);
});

/** The box of what is not background, in pixels of the picture. */
function silhouette({ width, height, data }: Pixels) {
  const box = { left: width, right: 0, top: height, bottom: 0 };
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      const at = 4 * (y * width + x);
      if ((data[at] ?? 0) + (data[at + 1] ?? 0) + (data[at + 2] ?? 0) < 12) continue;
      box.left = Math.min(box.left, x);
      box.right = Math.max(box.right, x + 1);
      box.top = Math.min(box.top, y);
      box.bottom = Math.max(box.bottom, y + 1);
    }
  }
  return box;
}

/** What lies under a place of the picture: its world position, as the page says it. */
async function positionAt(x: number, y: number): Promise<number[]> {
  await client.page.mouse.move(1, 1);
  await client.page.locator(".picked").waitFor({ state: "detached" });
  await client.page.mouse.move(x, y);
  const text = await client.page.locator(".picked").textContent();
  return (/at (\S+), (\S+), (\S+?)(?:cell|$)/.exec(text ?? "") ?? []).slice(1).map(Number);
}

describe("turning", () => {
  it("stops at the pole as a turntable, and goes over it as a trackball", async () => {
    const up = () => client.after(() => client.drag(0, 190));
    await up();
    const pole = await picture();
    await press("ArrowDown"); // The same camera once more.
    expect(await picture()).toBe(pole);
    await press("r");
    await client.page.keyboard.press("t");
    await up();
    const before = await picture();
    await press("ArrowDown");
    expect(await picture()).not.toBe(before);
    await client.after(() => client.page.keyboard.press("t")); // Stands upright again.
    await press("r");
    expect(await picture()).toBe(home);
  });

  it("looks around with Alt", async () => {
    await client.page.keyboard.down("Alt");
    await client.after(() => client.drag(60, 0));
    await client.page.keyboard.up("Alt");
    expect(await picture()).not.toBe(home);
  });

  it("flies while keys are held", async () => {
    for (const key of ["w", "a", "e"]) {
      const before = await picture();
      const seq = Number(await client.fact("inputSeq"));
      await client.page.keyboard.down(key);
      await client.page.waitForFunction(
        (least) =>
          Number(document.querySelector<HTMLElement>(".picture")?.dataset.inputSeq) > least,
        seq + 1,
      );
      await client.page.keyboard.up(key);
      await client.settled(seq);
      expect(await picture()).not.toBe(before);
    }
  });

  it("looks along an axis by a click on it, as by its key and by the menu", async () => {
    await press("1");
    const fromX = await picture();
    await press("r");
    await client.after(() => client.page.getByRole("button", { name: "Look from plus X" }).click());
    expect(await picture()).toBe(fromX);
    await press("r");
    await menu().click();
    await client.after(() =>
      client.page.getByRole("button", { name: "Plus X", exact: true }).click(),
    );
    await client.page.keyboard.press("Escape");
    expect(await picture()).toBe(fromX);
  });
});

describe("over the picture", () => {
  const box = () => client.page.locator(".box-overlay");

  /** The drawn edges, in CSS pixels of the picture. */
  async function edges() {
    const host = await client.page.locator(".picture").boundingBox();
    const at = await box().evaluate((svg) => {
      const rects = [...svg.querySelectorAll("line")].map((e) => e.getBoundingClientRect());
      return {
        left: Math.min(...rects.map((r) => r.left)),
        right: Math.max(...rects.map((r) => r.right)),
        top: Math.min(...rects.map((r) => r.top)),
        bottom: Math.max(...rects.map((r) => r.bottom)),
      };
    });
    const { x, y } = host ?? { x: 0, y: 0 };
    return { left: at.left - x, right: at.right - x, top: at.top - y, bottom: at.bottom - y };
  }

  it.each([
    ["perspective", false],
    ["orthographic", true],
  ])("the box bounds what is drawn (%s)", async (_, flat) => {
    await client.page.keyboard.press("b");
    if (flat) await press("p");
    await client.after(() => client.drag(-40, 25));
    const drawn = silhouette(await client.pixels());
    const bounds = await edges();
    for (const side of ["left", "right", "top", "bottom"] as const) {
      // A pixel's width, and as much again for the half that is covered or not.
      expect(Math.abs(drawn[side] - bounds[side]), side).toBeLessThanOrEqual(2);
    }
    if (flat) await client.page.screenshot({ path: join(screenshotFolder(), "box-860.png") });
    await client.page.keyboard.press("b");
    await expect.poll(() => box().count()).toBe(0);
  });

  it("the scale bar is as long as what it is laid on", async () => {
    await press("p");
    await press("3");
    const { x, y } = await client.middle();
    const [left, right] = [x - 100, x + 100];
    const from = await positionAt(left, y - 100);
    const to = await positionAt(right, y - 100);
    const world = Math.hypot(...from.map((c, i) => c - (to[i] ?? Number.NaN)));
    const text = (await client.page.locator(".scale-bar").textContent()) ?? "";
    const length = Number.parseFloat(text);
    const line = await client.page.locator(".scale-bar-line").boundingBox();
    expect(text).toMatch(/^[\d.e-]+ units?$/);
    // Positions are shown with five digits.
    expect((length / (line?.width ?? 0)) * 200).toBeCloseTo(world, 2);
    await press("p");
    await expect
      .poll(() => client.page.locator(".scale-bar").textContent())
      .toContain("at the centre");
  });

  it("the legend shows the map that is drawn", async () => {
    await client.after(() =>
      client.page.getByRole("radio", { name: "Volume", exact: true }).check({ force: true }),
    );
    const bar = client.page.locator(".legend-bar");
    const colours = (): Promise<string> => bar.evaluate((e) => getComputedStyle(e).backgroundImage);
    const before = await colours();
    const ticks = await client.page.locator(".legend-tick").allTextContents();
    expect(ticks.length).toBeGreaterThan(2);
    const numbers = ticks.map(Number);
    expect(numbers).toEqual([...numbers].sort((a, b) => a - b));
    const name = await client.page.locator(".legend figcaption").textContent();
    expect(name?.trim()).not.toBe("");
    await client.after(() => client.page.getByRole("button", { name: "Inferno colours" }).click());
    expect(await colours()).not.toBe(before);
    await client.after(() => client.page.keyboard.press("Control+z"));
    expect(await colours()).toBe(before);
    await client.after(() => client.page.keyboard.press("Control+z"));
  });

  it("is there or not, as the menu says by keys alone, and stays so", async () => {
    await menu().focus();
    await client.page.keyboard.press("Enter");
    for (const name of ["Orientation axes", "Scale bar", /^Legend/]) {
      await client.page.getByLabel(name).focus();
      await client.page.keyboard.press("Space");
    }
    await expect.poll(() => client.page.locator(".overlay").count()).toBe(0);
    expect(await violations(client)).toEqual([]);
    await client.page.reload();
    await client.settled();
    await expect.poll(() => client.page.locator(".overlay").count()).toBe(0);
    await menu().click();
    for (const name of ["Orientation axes", "Scale bar", /^Legend/]) {
      await client.page.getByLabel(name).check();
    }
    await client.page.keyboard.press("Escape");
    await client.page.locator(".axes").waitFor();
    expect(client.complaints).toEqual([]);
  });
});

describe("looks", () => {
  it.each([
    ["1280", { viewport: { width: 1280, height: 800 }, colorScheme: "light" as const }],
    [
      "390",
      { viewport: { width: 390, height: 844 }, hasTouch: true, colorScheme: "dark" as const },
    ],
  ])("%s pixels wide, with everything shown", async (name, options) => {
    const other = await place.open(options);
    const shot = (what: string): Promise<Buffer> =>
      other.page.screenshot({ path: join(screenshotFolder(), `viewport-${name}${what}.png`) });
    await other.page.locator(".picture").focus();
    await other.page.keyboard.press("b");
    await other.page.locator(".box-overlay").waitFor();
    expect(await violations(other)).toEqual([]);
    await shot("");
    await other.page.getByRole("button", { name: "View", exact: true }).click();
    await other.page.getByLabel("Scale bar").waitFor();
    expect(await violations(other)).toEqual([]);
    await shot("-menu");
    await other.close();
  });
});
