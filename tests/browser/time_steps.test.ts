import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const kSide = 6;
const kSteps = 4;

/** A cube of tetrahedra, six in each small cube. */
function cube(): { points: number[][]; cells: number[][] } {
  const id = (x: number, y: number, z: number): number => (z * kSide + y) * kSide + x;
  const points: number[][] = [];
  const cells: number[][] = [];
  for (let i = 0; i < kSide ** 3; i += 1) {
    points.push([i % kSide, Math.floor(i / kSide) % kSide, Math.floor(i / kSide ** 2)]);
  }
  const paths = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
  ];
  for (const [x = 0, y = 0, z = 0] of points.filter((p) => p.every((c) => c < kSide - 1))) {
    for (const path of paths) {
      const at = [x, y, z] as [number, number, number];
      const cell = [id(...at)];
      for (const axis of path) {
        at[axis as 0 | 1 | 2] += 1;
        cell.push(id(...at));
      }
      cells.push(cell);
    }
  }
  return { points, cells };
}

/** A hot spot that wanders through the cube, as XDMF with everything in the file itself. */
function writeSteps(path: string): void {
  const { points, cells } = cube();
  const item = (rows: readonly (readonly number[])[], kind: string): string =>
    `<DataItem Dimensions="${rows.length} ${rows[0]?.length}" NumberType="${kind}" Format="XML">` +
    `${rows.map((row) => row.join(" ")).join("\n")}</DataItem>`;
  const mesh =
    `<Topology NumberOfElements="${cells.length}" TopologyType="Tetrahedron" NodesPerElement="4">` +
    `${item(cells, "UInt")}</Topology><Geometry GeometryType="XYZ">${item(points, "Float")}</Geometry>`;
  const grids = Array.from({ length: kSteps }, (_, step) => {
    const middle = 1 + step;
    const values = points.map((p) => [Math.exp(-0.5 * Math.hypot(...p.map((c) => c - middle)))]);
    const attribute = `<Attribute Name="heat" AttributeType="Scalar" Center="Node">${item(values, "Float")}</Attribute>`;
    return `<Grid Name="mesh" GridType="Uniform">${mesh}<Time Value="${step}" />${attribute}</Grid>`;
  });
  const collection = `<Grid Name="heat" GridType="Collection" CollectionType="Temporal">${grids.join("")}</Grid>`;
  writeFileSync(
    path,
    `<?xml version="1.0"?><Xdmf Version="3.0"><Domain>${collection}</Domain></Xdmf>`,
  );
}

const place = setUp({ data: (folder) => writeSteps(join(folder, "heat.xdmf")) });
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 700 } });
});

const slider = () => client.page.getByRole("slider", { name: "Time step" });
const shown = () => client.page.locator(".time-step").textContent();
const picture = async (): Promise<string> => hashOf(await client.pixels());

/** Writes down each step that the page shows from now on, with whether its picture was waited for. */
const follow = (): Promise<void> =>
  client.page.evaluate(() => {
    const seen: string[] = [];
    Object.assign(window, { seenSteps: seen });
    const text = document.querySelector(".time-step");
    if (!text) throw new Error("there are no time steps");
    const look = (): void => {
      seen.push(text.textContent ?? "");
    };
    new MutationObserver(look).observe(text, {
      characterData: true,
      childList: true,
      subtree: true,
    });
  });
const seen = (): Promise<string[]> =>
  client.page.evaluate(() => (window as unknown as { seenSteps: string[] }).seenSteps);
const seenAtLeast = (count: number): Promise<unknown> =>
  client.page.waitForFunction(
    (least) => (window as unknown as { seenSteps: string[] }).seenSteps.length >= least,
    count,
    { timeout: 60_000 },
  );

describe("time steps", () => {
  const pictures: string[] = [];

  it("are shown one by one, each with a picture of its own", async () => {
    expect(await shown()).toBe("1 of 4");
    pictures.push(await picture());
    await slider().focus();
    for (let step = 1; step < kSteps; step += 1) {
      await client.after(() => client.page.keyboard.press("ArrowRight"));
      expect(await shown()).toBe(`${step + 1} of 4`);
      pictures.push(await picture());
    }
    expect(new Set(pictures).size).toBe(kSteps);
    expect(await violations(client)).toEqual([]);
    await client.page.screenshot({ path: join(screenshotFolder(), "time-1000.png") });
  });

  it("play to the end where they do not begin again, from the first", async () => {
    await client.page.getByLabel("Begin again at the end").uncheck();
    await client.page.getByLabel("Steps a second, at most").selectOption("25");
    await follow();
    await client.after(() => client.page.getByRole("button", { name: /^Play/ }).click());
    await client.page.getByRole("button", { name: /^Play/ }).waitFor();
    await client.settled();
    expect(await seen()).toEqual(["1 of 4", "2 of 4", "3 of 4", "4 of 4"]);
    expect(await picture()).toBe(pictures[kSteps - 1]);
  });

  it("go round until they are stopped, none left out, and are undone together", async () => {
    await client.page.getByLabel("Begin again at the end").check();
    await follow();
    await client.page.getByRole("button", { name: /^Play/ }).click();
    await seenAtLeast(6);
    await client.after(() => client.page.getByRole("button", { name: "Pause" }).click());
    const steps = (await seen()).map((text) => Number.parseInt(text, 10));
    steps.forEach((step, i) => {
      if (i > 0) expect(step).toBe(((steps[i - 1] ?? 0) % kSteps) + 1);
    });
    const now = Number.parseInt((await shown()) ?? "", 10);
    expect(await picture()).toBe(pictures[now - 1]);
    await client.after(() => client.page.getByRole("button", { name: "Undo" }).click());
    expect(await picture()).toBe(pictures[kSteps - 1]);
  });

  it("fit 390 pixels", async () => {
    await client.after(() => client.page.setViewportSize({ width: 390, height: 844 }));
    await slider().scrollIntoViewIfNeeded();
    await client.page.screenshot({ path: join(screenshotFolder(), "time-390.png") });
    expect(await violations(client)).toEqual([]);
    expect(client.complaints).toEqual([]);
  });
});
