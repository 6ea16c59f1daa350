import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 900 } });
  await client.choose("demo:volume");
  await client.page.locator("section", { hasText: "Shader" }).locator("summary").click();
});

const kCode = `#uicontrol invlerp range
#uicontrol vec3 tint color(default="#ff0000")
#uicontrol float strength slider(min=0, max=1, default=0.5)
#uicontrol bool turned checkbox
#uicontrol int part select(options={"whole": 1, "half": 2})
void main() {
  float x = turned ? 1.0 - range() : range();
  emitRGBA(vec4(tint * x, strength * x / float(part)));
}`;

const picture = async (): Promise<string> => hashOf(await client.pixels());
const editor = () => client.page.getByRole("textbox", { name: "Shader code" });
const complaints = () => client.page.locator(".complaints li");

describe("the shader editor", () => {
  it("draws code, which its controls change, and the map again", async () => {
    const byMap = await picture();
    await editor().fill(kCode);
    await client.after(() => editor().press("Control+Enter"));
    const seen = new Set([byMap, await picture()]);
    const steps = [
      () => client.page.getByLabel("tint", { exact: true }).fill("#0000ff"),
      () => client.page.getByRole("slider", { name: "strength" }).fill("0.9"),
      () => client.page.getByLabel("turned").check(),
      async () => {
        await client.page
          .getByRole("combobox", { name: "part", exact: true })
          .selectOption({ label: "half" });
      },
      async () => {
        const end = client.page.getByRole("textbox", { name: "range, 1 at, as a number" });
        await end.fill("0.5");
        await end.press("Enter");
      },
      () => client.page.getByRole("slider", { name: "range, 0 at" }).fill("0.2"),
    ];
    for (const step of steps) {
      await client.after(step);
      seen.add(await picture());
    }
    expect(seen.size).toBe(steps.length + 2);
    const last = await picture();
    await client.page.reload();
    await client.settled();
    expect(await picture()).toBe(last);
    await expect.poll(() => client.page.getByLabel("turned").isChecked()).toBe(true);
    await client.page.locator("section", { hasText: "Shader" }).locator("summary").click();
    await client.after(() => client.page.getByRole("button", { name: "Use the map" }).click());
    expect(await picture()).toBe(byMap);
    await expect.poll(() => editor().inputValue()).toBe(kCode);
  });

  it("says by line what is wrong, and leaves the picture", async () => {
    const before = await picture();
    await editor().fill("void main() {\n  discard;\n}");
    await editor().press("Control+Enter");
    await complaints().first().waitFor();
    await expect.poll(() => complaints().first().innerText()).toMatch(/^Line 2/);
    await expect.poll(() => editor().getAttribute("aria-invalid")).toBe("true");
    expect(await picture()).toBe(before);
    expect(client.complaints).toEqual([]);
  });

  it("says what only compiling shows, and keeps the code when it is taken back", async () => {
    const before = await picture();
    const wrong = "void main() {\n  emitRGBA(vec4(nothing));\n}";
    await editor().fill(wrong);
    await editor().press("Control+Enter");
    const note = client.page.locator(".refusal");
    await note.waitFor();
    await expect.poll(() => note.innerText()).toMatch(/^Shader: line 2/);
    await client.page.getByRole("button", { name: "Take back" }).click();
    await client.settled();
    await expect.poll(picture, { timeout: 20_000 }).toBe(before);
    await expect.poll(() => editor().inputValue()).toBe(wrong);
  });

  it("indents with Tab, and is left with Shift+Tab", async () => {
    await editor().fill("");
    await editor().press("Tab");
    await expect.poll(() => editor().inputValue()).toBe("  ");
    await editor().press("Shift+Tab");
    expect(await editor().evaluate((e) => e === document.activeElement)).toBe(false);
  });
});

const kMapCode = `#uicontrol transferFunction map(controlPoints=[[0.2, "#000000", 0], [0.9, "#ff8000", 0.4]])
void main() {
  emitRGBA(map());
}`;

async function apply(code: string): Promise<void> {
  await editor().fill(code);
  await client.after(() => editor().press("Control+Enter"));
}

describe("the examples", () => {
  const examples = () => client.page.getByLabel("Start from an example");

  it("each draw something of their own", async () => {
    const own = "void main() { emitRGB(vec3(1.0)); }";
    await editor().fill(own);
    const names = (await examples().locator("option").allTextContents()).slice(1);
    expect(names.length).toBeGreaterThanOrEqual(7);
    for (const kind of ["slider", "color", "checkbox", "select", "invlerp", "transferFunction"]) {
      expect(
        names.some((name) => name.startsWith(`${kind}:`)),
        kind,
      ).toBe(true);
    }
    const seen = new Set<string>();
    for (const name of names) {
      await examples().selectOption({ label: name });
      await client.after(() => editor().press("Control+Enter"));
      await expect.poll(() => complaints().count(), { message: name }).toBe(0);
      seen.add(await picture());
    }
    // The tinted range begins as the colours' one does, for values of the demo: some may agree.
    expect(seen.size).toBeGreaterThanOrEqual(names.length - 1);
    await examples().selectOption({ label: "Back to your own code" });
    await expect.poll(() => editor().inputValue()).toBe(own);
    expect(client.complaints).toEqual([]);
  });

  it("a complaint shows its line", async () => {
    await editor().fill("void main() {\n  discard;\n}");
    await editor().press("Control+Enter");
    await complaints().first().getByRole("button").click();
    const chosen = await editor().evaluate((e: HTMLTextAreaElement) =>
      e.value.slice(e.selectionStart, e.selectionEnd),
    );
    expect(chosen).toBe("  discard;");
  });
});

describe("a transferFunction control", () => {
  const points = () => client.page.locator(".shader-map .map-point");
  const field = (name: string) =>
    client.page.locator(".shader-map").getByRole("textbox", { name, exact: true });

  it("is edited by mouse, by keyboard and in numbers", async () => {
    await apply(kMapCode);
    const declared = await picture();
    await client.page.locator(".shader-map .map-ground").scrollIntoViewIfNeeded();
    const ground = await client.page.locator(".shader-map .map-ground").boundingBox();
    if (!ground) throw new Error("the editor has no ground");
    await client.after(async () => {
      await client.page.mouse.dblclick(ground.x + ground.width * 0.6, ground.y + 20);
    });
    await expect.poll(() => points().count()).toBe(3);
    expect(await picture(), "a new point changes nothing").toBe(declared);
    const middle = points().nth(1);
    await expect.poll(() => middle.getAttribute("aria-pressed")).toBe("true");
    const seen = new Set([declared]);
    const steps = [
      async () => {
        const box = await middle.boundingBox();
        if (!box) throw new Error("the point has no box");
        await client.page.mouse.move(box.x + 12, box.y + 12);
        await client.page.mouse.down();
        await client.page.mouse.move(box.x - 20, box.y - 30, { steps: 4 });
        await client.page.mouse.up();
      },
      () => middle.press("ArrowUp"),
      () => middle.press("ArrowRight"),
      async () => {
        await field("Opacity %").fill("80");
        await field("Opacity %").press("Enter");
      },
      () => client.page.locator(".shader-map").getByLabel("Colour").fill("#00ff00"),
    ];
    for (const step of steps) {
      await client.after(step);
      seen.add(await picture());
    }
    expect(seen.size).toBe(steps.length + 1);
    await client.after(() => middle.press("Delete"));
    expect(await picture(), "without it the map is as declared").toBe(declared);
    const before = await points().first().boundingBox();
    await client.after(async () => {
      await field("Window to").fill("2");
      await field("Window to").press("Enter");
    });
    expect(await picture(), "the window is the editor's own").toBe(declared);
    expect((await points().first().boundingBox())?.x).not.toBe(before?.x);
    expect(client.complaints).toEqual([]);
  });
});

describe("code on cross-sections and on a mesh", () => {
  it("colours planes", async () => {
    const radio = (name: RegExp) => client.page.getByRole("radio", { name });
    await client.after(() => radio(/^Sections/).check({ force: true }));
    const byMap = await picture();
    await apply("void main() { emitRGB(vec3(0.0, toNormalized(getDataValue()), 0.0)); }");
    expect(await picture()).not.toBe(byMap);
    await client.after(() => radio(/^Volume/).check({ force: true }));
  });

  it("shows fields by their number, sampled as the panel says", async () => {
    const row = client.page.locator('.dataset[data-dataset="demo:mesh"]');
    await client.after(() => row.locator(".dataset-choose").click());
    const byMap = await picture();
    const code = client.page.locator("section", { hasText: "Shader" }).locator("details");
    if ((await code.getAttribute("open")) === null) await code.locator("summary").click();
    await apply(
      "#uicontrol invlerp range\n#uicontrol float opacity slider(min=0, max=1, default=0.2)\n" +
        "void main() { float x = range(); emitRGBA(vec4(x, 1.0 - x, 0.5, opacity * x)); }",
    );
    const seen = new Set([byMap, await picture()]);
    const steps = [
      () => client.page.getByRole("slider", { name: "opacity" }).fill("0.9"),
      async () => {
        await client.page
          .getByRole("combobox", { name: "Samples", exact: true })
          .selectOption({ label: "By their number" });
      },
      async () => {
        const count = client.page.getByRole("textbox", { name: "Samples over the depth" });
        await count.fill("2000");
        await count.press("Enter");
      },
    ];
    for (const step of steps) {
      await client.after(step);
      seen.add(await picture());
    }
    // Cells are smaller than a 64th of the diagonal: only the last of these asks more often.
    expect(seen.size).toBe(4);
    expect(client.complaints).toEqual([]);
  });
});
