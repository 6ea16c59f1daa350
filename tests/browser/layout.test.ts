import { join } from "node:path";
import type { BrowserContextOptions } from "playwright-core";
import { describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import { launch } from "./support/browser";
import { Client } from "./support/client";
import { difference } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp();

const kWide = { viewport: { width: 1280, height: 800 } };
const kNarrow = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

interface Look {
  readonly name: string;
  readonly options: BrowserContextOptions;
}

const kLooks: Look[] = [
  { name: "1280-light", options: { ...kWide, colorScheme: "light" } },
  { name: "1280-dark", options: { ...kWide, colorScheme: "dark" } },
  { name: "390-light", options: { ...kNarrow, colorScheme: "light", deviceScaleFactor: 2 } },
  { name: "390-dark", options: { ...kNarrow, colorScheme: "dark", deviceScaleFactor: 2 } },
];

describe("layout", () => {
  it.each(kLooks)("$name fits, is accessible and is photographed", async ({ name, options }) => {
    const client = await place.open(options);
    const shot = (what: string): Promise<Buffer> =>
      client.page.screenshot({ path: join(screenshotFolder(), `${what}.png`) });
    expect(await violations(client)).toEqual([]);
    await shot(name);
    const toggle = client.page.locator(".sheet-toggle");
    if (await toggle.isVisible()) {
      await client.after(() => toggle.click());
      await client.page.locator(".map-plot").scrollIntoViewIfNeeded();
      expect(await violations(client)).toEqual([]);
      await shot(`${name}-open`);
    }
    const overflow = await client.page.evaluate(
      () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
    );
    expect(overflow).toBe(0);
    await client.close();
  });

  // Between the sheet and the panel, and where a screen has room to spare: looks of one page.
  it.each([
    [768, 1024],
    [2560, 1440],
  ])("%s pixels fit, and nothing lies over anything else", async (width, height) => {
    const client = await place.open({ viewport: { width, height } });
    for (const colorScheme of ["light", "dark"] as const) {
      await client.page.emulateMedia({ colorScheme });
      expect(await violations(client)).toEqual([]);
      await client.page.screenshot({
        path: join(screenshotFolder(), `${width}-${colorScheme}.png`),
      });
    }
    const found = await client.page.evaluate(() => {
      const { scrollWidth, clientWidth } = document.documentElement;
      const kinds = ".tools, .badge, .readout, .legend, .axes, .scale-bar, .panel";
      const parts = [...document.querySelectorAll(kinds)]
        .filter((e, _, all) => !all.some((other) => other !== e && other.contains(e)))
        .map((e) => ({ name: e.className, box: e.getBoundingClientRect() }))
        .filter(({ box }) => box.width > 0 && box.height > 0);
      const overlaps = parts.flatMap((a, i) =>
        parts.slice(i + 1).flatMap((b) => {
          const apart =
            a.box.right <= b.box.left ||
            b.box.right <= a.box.left ||
            a.box.bottom <= b.box.top ||
            b.box.bottom <= a.box.top;
          return apart ? [] : [`${a.name} and ${b.name}`];
        }),
      );
      const body = document.querySelector(".panel-body");
      const aside = body ? body.scrollWidth - body.clientWidth : -1;
      return { overflow: scrollWidth - clientWidth, aside, overlaps, parts: parts.length };
    });
    expect(found).toMatchObject({ overflow: 0, aside: 0, overlaps: [] });
    expect(found.parts).toBeGreaterThan(4);
    await client.close();
  });

  it("has an accessible help and readout", async () => {
    const client = await place.open(kWide);
    await client.page.locator(".readout summary").click();
    await client.page.keyboard.press("Shift+Slash");
    await client.page.waitForSelector("dialog[open]");
    expect(await violations(client)).toEqual([]);
    await client.page.keyboard.press("Escape");
    await client.page.waitForSelector("dialog", { state: "detached" });
    await client.close();
  });

  it.each(["Escape", "Enter"])("a dialog keeps the focus until %s gives it back", async (key) => {
    const client = await place.open(kWide);
    const opener = client.page.getByRole("button", { name: "Share", exact: true });
    await opener.press("Enter");
    await client.page.waitForSelector("dialog[open]");
    for (let i = 0; i < 12; i += 1) {
      // Past the last control the browser's own may have the focus, never the page behind.
      expect(
        await client.page.evaluate(
          () =>
            document.activeElement === document.body ||
            document.activeElement?.closest("dialog[open]") !== null,
        ),
      ).toBe(true);
      await client.page.keyboard.press("Tab");
    }
    if (key === "Enter") await client.page.getByRole("button", { name: "Close" }).focus();
    await client.page.keyboard.press(key);
    await client.page.waitForSelector("dialog", { state: "detached" });
    expect(await opener.evaluate((e) => e === document.activeElement)).toBe(true);
    await client.close();
  });

  it.each([kLooks[0], kLooks[3]] as Look[])(
    "$name has accessible panels of voxels",
    async (look) => {
      const client = await place.open(look.options);
      const toggle = client.page.locator(".sheet-toggle");
      if (await toggle.isVisible()) await client.after(() => toggle.click());
      const row = client.page.locator('.dataset[data-dataset="demo:volume"] .dataset-choose');
      await client.after(() => row.click());
      await client.after(() => client.page.getByLabel("Light", { exact: true }).check());
      await client.page.locator("section", { hasText: "Shader" }).locator("summary").click();
      await client.page.locator(".code").fill("void");
      await client.page.locator(".code").press("Control+Enter");
      await client.page.locator(".complaints li").first().waitFor();
      expect(await violations(client)).toEqual([]);
      await client.page.screenshot({ path: join(screenshotFolder(), `${look.name}-voxels.png`) });
      const body = client.page.locator(".panel-body");
      expect(await body.evaluate((e) => e.scrollWidth - e.clientWidth)).toBe(0);
      await client.close();
    },
  );

  it.each([1.5, 2])("draws device pixels at a scale of %s", async (deviceScaleFactor) => {
    const viewport = { width: 801, height: 500 };
    const client = await place.open({ viewport, deviceScaleFactor });
    const box = await client.page.locator(".picture canvas").boundingBox();
    const [width = 0, height = 0] = (await client.fact("size")).split("x").map(Number);
    expect(Math.abs(width - (box?.width ?? 0) * deviceScaleFactor)).toBeLessThan(1);
    expect(Math.abs(height - (box?.height ?? 0) * deviceScaleFactor)).toBeLessThan(1);
    if (deviceScaleFactor === 2) {
      expect(difference(await client.pixels(), await client.sent()).largest).toBe(0);
    }
    await client.close();
  });

  it("draws device pixels on a screen that really has 1.5 of them a CSS pixel", async () => {
    const scaled = await launch(["--force-device-scale-factor=1.5", "--window-size=901,600"]);
    try {
      const client = await Client.open(scaled, place.url, { viewport: null });
      const exact = await client.page.evaluate(
        () =>
          new Promise<string>((resolve) => {
            const canvas = document.querySelector(".picture canvas");
            const look = new ResizeObserver(([entry]) => {
              const box = entry?.devicePixelContentBoxSize?.[0];
              resolve(`${box?.inlineSize}x${box?.blockSize}`);
            });
            if (canvas) look.observe(canvas, { box: "device-pixel-content-box" });
          }),
      );
      expect(await client.page.evaluate(() => window.devicePixelRatio)).toBe(1.5);
      expect(await client.fact("size")).toBe(exact);
    } finally {
      await scaled.close();
    }
  });

  it("follows the window's size", async () => {
    const client = await place.open(kWide);
    await client.after(() => client.page.setViewportSize({ width: 1000, height: 640 }));
    const box = await client.page.locator(".picture canvas").boundingBox();
    expect(await client.fact("size")).toBe(`${box?.width}x${box?.height}`);
    await client.close();
  });

  it("the legend of a narrow picture lies beside its middle", async () => {
    const client = await place.open(kNarrow);
    const places = async () => {
      const legend = await client.page.locator(".legend").boundingBox();
      const axes = await client.page.locator(".axes").boundingBox();
      const picture = await client.page.locator(".picture").boundingBox();
      if (!legend || !axes || !picture) throw new Error("something has no box");
      return { legend, axes, picture };
    };
    const apart = async (): Promise<void> => {
      const { legend, axes, picture } = await places();
      expect(legend.y + legend.height).toBeLessThan(picture.y + picture.height / 3);
      expect(legend.x).toBeGreaterThanOrEqual(picture.x);
      expect(legend.x + legend.width).toBeLessThanOrEqual(axes.x);
    };
    await apart();
    await client.after(() => client.page.locator(".sheet-toggle").click());
    await apart();
    await client.close();
  });

  it("keeps the sheet on top of nothing that it hides", async () => {
    const client = await place.open(kNarrow);
    const closed = await client.page.locator(".picture").boundingBox();
    await client.after(() => client.page.locator(".sheet-toggle").click());
    const open = await client.page.locator(".picture").boundingBox();
    const panel = await client.page.locator(".panel").boundingBox();
    expect(open?.height).toBeLessThan(closed?.height ?? 0);
    expect((open?.y ?? 0) + (open?.height ?? 0)).toBeLessThanOrEqual((panel?.y ?? 0) + 0.5);
    await client.close();
  });
});
