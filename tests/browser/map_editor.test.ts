import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { decodeSrgb } from "../../web_client/src/transfer/srgb";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { writeVoxels } from "./support/data";
import { difference, hashOf, type Pixels } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

/** Device pixels a CSS pixel. */
const kScale = 2;
/** ui/map_plot.ts: the plot's height, its upper margin, the margin at its sides, in CSS pixels. */
const kPlot = { height: 136, top: 10, side: 10 };

const place = setUp({ data: writeData });
let client: Client;

function writeData(folder: string): void {
  writeVoxels(folder, "ramp", { size: [52, 12, 12], value: (x) => 5 * x });
  // As thick as the length that opacities are over, a tenth of the diagonal: t = sqrt(2 63^2 / 99).
  const spacing = [1, 1, Math.sqrt((2 * 63 ** 2) / 99) / 8] as const;
  const value = (x: number, y: number): number => (x + y === 0 ? 0 : x + y === 126 ? 255 : 128);
  writeVoxels(folder, "plate", { size: [64, 64, 9], spacing, value });
}

beforeAll(async () => {
  client = await place.open({
    viewport: { width: 760, height: 320 },
    deviceScaleFactor: kScale,
  });
});

async function choose(name: string): Promise<void> {
  const row = client.page.locator(`.dataset[data-dataset="${name}.mhd"]`);
  if ((await row.getAttribute("data-shown")) !== null) return;
  await client.after(async () => {
    await row.locator(".dataset-choose").click();
    await row.and(client.page.locator("[data-shown]")).waitFor();
  });
}

async function model(name: RegExp): Promise<void> {
  const radio = client.page.getByRole("radio", { name });
  if (!(await radio.isChecked())) await client.after(() => radio.check({ force: true }));
}

/** What the editor has on its canvas. */
async function editorPixels(): Promise<Pixels> {
  const { width, height, data } = await client.page
    .locator(".map-ground canvas")
    .first()
    .evaluate((canvas: HTMLCanvasElement) => {
      const context = canvas.getContext("2d");
      const image = context?.getImageData(0, 0, canvas.width, canvas.height);
      return { width: canvas.width, height: canvas.height, data: Array.from(image?.data ?? []) };
    });
  return { width, height, data: Uint8Array.from(data) };
}

const colourAt = ({ width, data }: Pixels, x: number, y: number): number[] =>
  Array.from(data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3));

/** Between the middles of two pixels: an editor's column is wider than a step of a byte. */
function between(pixels: Pixels, x: number, y: number): number[] {
  const left = Math.floor(x - 0.5);
  const t = x - 0.5 - left;
  const next = colourAt(pixels, left + 1, y);
  return colourAt(pixels, left, y).map((c, k) => Math.round(c + t * ((next[k] ?? c) - c)));
}

const field = (name: string) => client.page.getByLabel(name, { exact: true }).first();
const numberIn = async (name: string): Promise<number> => Number(await field(name).inputValue());

/** Where a value of the map's range lies in the editor, in device pixels. */
async function columnOf(value: number, width: number): Promise<number> {
  const [from, to] = [await numberIn("From"), await numberIn("To")];
  const inner = width / kScale - 2 * kPlot.side;
  return kScale * (kPlot.side + ((value - from) / (to - from)) * inner);
}

async function openMap(json: unknown): Promise<void> {
  const path = join(place.folder, "opened.map.json");
  writeFileSync(path, JSON.stringify(json));
  const files = client.page.locator(".map-files").first();
  if ((await files.getAttribute("open")) === null) await files.locator("summary").click();
  const chooser = client.page.waitForEvent("filechooser");
  await client.page.getByRole("button", { name: "Open a map" }).first().click();
  await (await chooser).setFiles(path);
}

const white = { r: 1, g: 1, b: 1 };
const points = () => client.page.locator(".map-point");
const picture = async (): Promise<string> => hashOf(await client.pixels());

describe("what the editor draws is what the renderer draws", () => {
  it("colours, to a step of a byte", async () => {
    await choose("ramp");
    await model(/OFF/);
    const bar = await editorPixels();
    const shown = await client.pixels();
    const box = await client.page.locator(".picture").boundingBox();
    if (!box) throw new Error("the picture has no box");
    const line = client.page.locator(".picked");
    let compared = 0;
    for (let i = 1; i < 20; i += 1) {
      const [x, y] = [box.x + (box.width * i) / 20 + 0.25, box.y + box.height / 2 + 0.25];
      await client.page.mouse.move(x, y);
      const said = await line
        .waitFor({ timeout: 1500 })
        .then(() => line.locator(".picked-value").innerText())
        .catch(() => "");
      const value = Number(/(-?[\d.e+-]+)\s*$/.exec(said.trim())?.[1] ?? "NaN");
      await client.page.mouse.move(box.x + 3, box.y + 3);
      await line.waitFor({ state: "detached" });
      if (!Number.isFinite(value)) continue;
      const drawn = between(bar, await columnOf(value, bar.width), bar.height - 7 * kScale);
      const at = { x: Math.floor((x - box.x) * kScale), y: Math.floor((y - box.y) * kScale) };
      const rendered = colourAt(shown, at.x, at.y);
      drawn.forEach((c, k) => {
        expect(
          Math.abs(c - (rendered[k] ?? -9)),
          `${value}: ${drawn} ${rendered}`,
        ).toBeLessThanOrEqual(1);
      });
      compared += 1;
    }
    expect(compared).toBeGreaterThan(5);
  });

  it("opacity, to 1/255 of light", async () => {
    await choose("plate");
    await model(/ON/);
    await client.page.locator(".picture").focus();
    await client.after(() => client.page.keyboard.press("3"));
    await client.after(() => client.page.keyboard.press("p"));
    for (const opacity of [0.15, 0.5, 0.8]) {
      const extinction = -Math.log(1 - opacity) / Math.sqrt((2 * 63 ** 2) / 99);
      await client.after(() =>
        openMap({
          points: [
            { value: 0, colour: white, extinction: 0 },
            { value: 100, colour: white, extinction: 0.3 * extinction },
            { value: 120, colour: white, extinction },
            { value: 136, colour: white, extinction },
            { value: 255, colour: white, extinction: 0.1 * extinction },
          ],
        }),
      );
      const canvas = await editorPixels();
      const ink = await client.page
        .locator(".map-ground canvas")
        .first()
        .evaluate((e) => getComputedStyle(e).getPropertyValue("--plot-curve").trim());
      const rgb = [1, 3, 5].map((k) => Number.parseInt(ink.slice(k, k + 2), 16));
      const column = Math.round(await columnOf(128, canvas.width));
      const rows: number[] = [];
      for (let y = 0; y < kPlot.height * kScale; y += 1) {
        const here = colourAt(canvas, column, y);
        if (here.every((c, k) => Math.abs(c - (rgb[k] ?? 0)) < 24)) rows.push(y + 0.5);
      }
      expect(rows.length, "the curve is there").toBeGreaterThan(0);
      const y = rows.reduce((a, b) => a + b, 0) / rows.length / kScale;
      const drawn = (kPlot.height - y) / (kPlot.height - kPlot.top);
      const shown = await client.pixels();
      const middle = colourAt(shown, shown.width >> 1, shown.height >> 1);
      const rendered = decodeSrgb((middle[1] ?? 0) / 255);
      expect(colourAt(shown, 2, shown.height - 3), "the ground is black").toEqual([0, 0, 0]);
      // A row of the canvas is half a CSS pixel: the curve's middle is known to half of that.
      expect(Math.abs(rendered - drawn), `${drawn} ${rendered}`).toBeLessThan(
        1 / 255 + 0.25 / (kPlot.height - kPlot.top),
      );
      expect(Math.abs(rendered - opacity)).toBeLessThan(1 / 255);
    }
  });
});

describe("by hand", () => {
  const ground = async () => {
    await client.page.locator(".map-ground").first().scrollIntoViewIfNeeded();
    const box = await client.page.locator(".map-ground").first().boundingBox();
    if (!box) throw new Error("the editor has no ground");
    return box;
  };
  const selected = () => client.page.locator('.map-point[aria-pressed="true"]');

  beforeAll(async () => {
    await choose("ramp");
    await model(/ON/);
    await client.page.locator(".map-ground").first().scrollIntoViewIfNeeded();
  });

  it("a click and a double click add one point each, and the picture stays to the bit", async () => {
    const count = await points().count();
    const before = await client.pixels();
    const box = await ground();
    await client.after(() => client.page.mouse.click(box.x + 0.41 * box.width, box.y + 14));
    await expect.poll(() => points().count()).toBe(count + 1);
    await client.after(() => client.page.mouse.dblclick(box.x + 0.63 * box.width, box.y + 14));
    await expect.poll(() => points().count()).toBe(count + 2);
    // On the curve itself, where the second click meets the new point.
    const on = await selected().boundingBox();
    await client.after(() => client.page.keyboard.press("Control+z"));
    await client.after(() => client.page.mouse.dblclick((on?.x ?? 0) + 12, (on?.y ?? 0) + 12));
    await expect.poll(() => points().count()).toBe(count + 2);
    expect(difference(before, await client.pixels()).largest).toBe(0);
    await client.after(() => selected().dblclick());
    await expect.poll(() => points().count()).toBe(count + 1);
    await client.after(() => client.page.keyboard.press("Control+z"));
    await client.after(() => selected().click({ button: "middle" }));
    await expect.poll(() => points().count()).toBe(count + 1);
  });

  it("with a modifier a click gives the selected colour", async () => {
    const hex = () => field("Colour").inputValue();
    await points().first().focus();
    const first = await hex();
    const box = await ground();
    await client.after(async () => {
      await client.page.keyboard.down("Shift");
      await client.page.mouse.click(box.x + 0.8 * box.width, box.y + 14);
      await client.page.keyboard.up("Shift");
    });
    expect(await hex()).toBe(first);
    const count = await points().count();
    const last = points().nth(count - 1);
    await client.after(() => last.click({ modifiers: ["Alt"] }));
    await expect.poll(() => points().count()).toBe(count);
    await last.focus();
    expect(await hex()).toBe(first);
  });

  it("a right click asks for another colour of the point", async () => {
    await points().nth(2).click({ button: "right" });
    await expect.poll(() => points().nth(2).getAttribute("aria-pressed")).toBe("true");
    const colour = field("Colour");
    await expect.poll(() => colour.evaluate((e) => e === document.activeElement)).toBe(true);
    await client.page.keyboard.press("Escape");
    const before = await picture();
    await client.after(() => colour.fill("#00ff00"));
    expect(await picture()).not.toBe(before);
  });

  it("is looked at closer, moved, and whole again, which changes no picture", async () => {
    const seq = await client.fact("inputSeq");
    const ends = () => client.page.locator(".map-scale").first().innerText();
    const whole = await ends();
    const box = await ground();
    await client.page.mouse.move(box.x + 0.5 * box.width, box.y + 40);
    await client.page.keyboard.down("Control");
    await client.page.mouse.wheel(0, -300);
    await client.page.keyboard.up("Control");
    await expect.poll(ends).not.toBe(whole);
    const near = await ends();
    await client.page.mouse.down();
    await client.page.mouse.move(box.x + 0.7 * box.width, box.y + 40, { steps: 4 });
    await client.page.mouse.up();
    await expect.poll(ends).not.toBe(near);
    expect(await violations(client)).toEqual([]);
    await client.page.getByRole("button", { name: "All", exact: true }).first().click();
    await expect.poll(ends).toBe(whole);
    await client.page.getByRole("button", { name: "Show less of the range" }).first().click();
    await expect.poll(ends).not.toBe(whole);
    await client.page.getByRole("button", { name: "Show more of the range" }).first().click();
    await expect.poll(ends).toBe(whole);
    expect(await client.fact("inputSeq")).toBe(seq);
  });

  it("counts are drawn by their logarithm, or as they are", async () => {
    await choose("plate"); // Of which one value is most.
    const log = hashOf(await editorPixels());
    await client.page.getByLabel("Logarithmic counts").first().uncheck();
    await expect.poll(async () => hashOf(await editorPixels())).not.toBe(log);
    await client.page.getByLabel("Logarithmic counts").first().check();
    await expect.poll(async () => hashOf(await editorPixels())).toBe(log);
  });
});

describe("ready-made and from files", () => {
  it("colours are reversed, and back", async () => {
    await choose("ramp"); // The plate's value is in the middle, where reversing changes nothing.
    const before = await client.pixels();
    const reverse = client.page.getByRole("button", { name: "Reverse" }).first();
    await client.after(() => reverse.click());
    expect(difference(before, await client.pixels()).largest).toBeGreaterThan(8);
    await client.after(() => reverse.click());
    expect(difference(before, await client.pixels()).largest).toBeLessThanOrEqual(1);
    await choose("plate");
  });

  it.each(["Save as JSON", "Save for ParaView"])("%s gives the same picture back", async (name) => {
    await client.after(() => client.page.getByRole("button", { name: "Magma colours" }).click());
    const before = await client.pixels();
    const files = client.page.locator(".map-files").first();
    if ((await files.getAttribute("open")) === null) await files.locator("summary").click();
    const download = client.page.waitForEvent("download");
    await files.getByRole("button", { name }).click();
    const path = await (await download).path();
    const json = JSON.parse(readFileSync(path, "utf8"));
    await client.after(() => client.page.getByRole("button", { name: "Grey colours" }).click());
    expect(difference(before, await client.pixels()).largest).toBeGreaterThan(8);
    await client.after(() => openMap(json));
    // A preset's colours and opacities are each within half a step of a byte.
    const most = name === "Save as JSON" ? 0 : 2;
    expect(difference(before, await client.pixels()).largest).toBeLessThanOrEqual(most);
  });

  it("what is no map is said, and changes nothing", async () => {
    const seq = await client.fact("inputSeq");
    await openMap({ points: [{ value: 1 }] });
    const problem = client.page.locator(".problem").first();
    await expect.poll(() => problem.innerText()).toMatch(/points\[0\]\.colour is missing/);
    expect(await violations(client)).toEqual([]);
    expect(await client.fact("inputSeq")).toBe(seq);
    expect(client.complaints).toEqual([]);
  });
});

describe("by touch", () => {
  it("a tap adds a point, two take it away", async () => {
    const options = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
    const phone = await place.open(options);
    await phone.after(() => phone.page.locator(".sheet-toggle").click());
    const ground = phone.page.locator(".map-ground").first();
    await ground.scrollIntoViewIfNeeded();
    const box = await ground.boundingBox();
    if (!box) throw new Error("the editor has no ground");
    const all = phone.page.locator(".map-point");
    const count = await all.count();
    await phone.after(() => phone.page.touchscreen.tap(box.x + 0.44 * box.width, box.y + 14));
    await expect.poll(() => all.count()).toBe(count + 1);
    await phone.page.screenshot({ path: join(screenshotFolder(), "390-map.png") });
    expect(await violations(phone)).toEqual([]);
    await phone.close();
  });
});
