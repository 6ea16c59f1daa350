import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { difference, hashOf } from "./support/pixels";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 800 } });
  await client.choose("demo:mesh");
});

const kModels = [
  "Surface",
  "Wireframe",
  "Maximum",
  "Minimum",
  "Max colour",
  "X-ray",
  "Splat",
  "Isosurface",
  "Volume",
];

async function model(name: string): Promise<void> {
  const radio = client.page.getByRole("radio", { name, exact: true });
  if (await radio.isChecked()) return;
  await client.after(() => radio.check({ force: true }));
}

const picture = async (): Promise<string> => hashOf(await client.pixels());

/** A setting by the name that a person reads; the label of a select has its options in it too. */
const setting = (name: string) =>
  client.page
    .getByLabel(name, { exact: true })
    .or(client.page.getByRole("combobox", { name, exact: true }));

const choose = (name: string, option: string): Promise<void> =>
  client.after(async () => {
    await setting(name).selectOption({ label: option });
  });

async function toggle(name: string): Promise<void> {
  await setting(name).setChecked(!(await setting(name).isChecked()));
}

async function type(name: string, text: string): Promise<void> {
  await setting(name).fill(text);
  await setting(name).press("Enter");
}

/** Makes every step, and expects that each shows another picture. */
async function expectEachDiffers(steps: readonly (() => Promise<void>)[]): Promise<void> {
  const seen = new Set([await picture()]);
  for (const step of steps) {
    await client.after(step);
    seen.add(await picture());
  }
  expect(seen.size).toBe(steps.length + 1);
}

const undo = (): Promise<void> =>
  client.after(() => client.page.getByRole("button", { name: "Undo", exact: true }).click());

describe("ray models", () => {
  it("are all offered and all draw pictures of their own", async () => {
    const radios = client.page.getByRole("radiogroup", { name: "Ray model" }).getByRole("radio");
    await expect.poll(() => radios.count()).toBe(kModels.length);
    const seen = new Set<string>();
    for (const name of kModels) {
      await model(name);
      seen.add(await picture());
    }
    expect(seen.size).toBe(kModels.length);
  });

  it("show only the parameters that they use", async () => {
    const shown: Record<string, string[]> = {
      "Edge width, pixels": ["Wireframe"],
      Headlight: ["Surface", "Wireframe", "Isosurface"],
      Levels: ["Isosurface"],
      "Strength, times the map’s": ["X-ray"],
      Exposure: ["Splat"],
      "Opacity curve": ["X-ray", "Volume"],
    };
    const found: Record<string, string[]> = {};
    for (const name of kModels) {
      await model(name);
      for (const label of Object.keys(shown)) {
        if ((await setting(label).count()) > 0) found[label] = [...(found[label] ?? []), name];
      }
    }
    expect(found).toEqual(shown);
  });

  it("can be stepped through with the keyboard", async () => {
    await model("Surface");
    await client.page.getByRole("radio", { name: "Surface", exact: true }).focus();
    await client.after(() => client.page.keyboard.press("ArrowRight"));
    await expect
      .poll(() => client.page.getByRole("radio", { name: "Wireframe" }).isChecked())
      .toBe(true);
  });
});

describe("parameters", () => {
  it("of a wireframe change its edges", async () => {
    await model("Wireframe");
    await expectEachDiffers([
      () => type("Edge width, pixels", "3"),
      () => setting("Edge colour").fill("#ff0000"),
      () => toggle("Headlight"),
      () => toggle("Coloured by the field"),
    ]);
  });

  it("of an isosurface place its levels", async () => {
    await model("Isosurface");
    await expectEachDiffers([
      () => setting("Level").press("ArrowRight"),
      () => toggle("Headlight"),
      async () => {
        await setting("Levels").selectOption({ label: "List" });
      },
      async () => {
        await setting("Levels").selectOption({ label: "Even steps" });
      },
      () => type("Count", "3"),
      async () => {
        await setting("Levels").selectOption({ label: "Power steps" });
      },
    ]);
    await choose("Levels", "One");
  });

  it("of x-ray and splat scale what is added up", async () => {
    await model("X-ray");
    await expectEachDiffers([() => type("Strength, times the map’s", "4")]);
    await model("Splat");
    await expectEachDiffers([() => type("Exposure, as a number", "-2")]);
    await expectEachDiffers([() => setting("Exposure").press("ArrowLeft")]);
  });
});

describe("what part of the data is drawn", () => {
  it("is a range of values", async () => {
    await model("Maximum");
    const whole = await picture();
    await client.page.getByLabel("Only a range of values").check();
    await client.settled();
    const to = client.page.getByRole("slider", { name: "To", exact: true });
    await client.after(() => to.fill("0.5"));
    expect(await picture()).not.toBe(whole);
    await undo();
    await client.after(() => client.page.getByLabel("Only a range of values").uncheck());
    expect(await picture()).toBe(whole);
  });

  it("is cut by planes, which can be moved, turned, flipped and removed", async () => {
    await model("Volume");
    const whole = await picture();
    const button = (name: string | RegExp) => client.page.getByRole("button", { name });
    await expectEachDiffers([
      () => button("Add a clip plane").click(),
      () => setting("Plane 1").fill("0.7"),
      async () => {
        await setting("Axis of plane 1").selectOption({ label: "Z" });
      },
      () => button(/^Plane 1: keep above/).click(),
      () => button("Add a clip plane").click(),
    ]);
    await client.after(() => button("Remove plane 2").click());
    await client.after(() => button("Remove plane 1").click());
    expect(await picture()).toBe(whole);
    for (let i = 0; i < 2; i += 1) await undo();
    expect(await picture()).not.toBe(whole);
    await client.after(() => button("Remove plane 2").click());
    await client.after(() => button("Remove plane 1").click());
  });

  it("follows the field's scale", async () => {
    await model("Volume");
    const straight = await picture();
    await choose("Scale", "Power");
    const bent = await picture();
    expect(bent).not.toBe(straight);
    await client.after(() => type("Exponent", "1"));
    expect(difference(await client.pixels(), await client.pixels()).largest).toBe(0);
    await choose("Scale", "Linear");
    expect(await picture()).toBe(straight);
  });
});

describe("accuracy", () => {
  const integrator = async (): Promise<string> => {
    await client.page.locator(".readout").evaluate((e) => e.setAttribute("open", ""));
    const row = client.page.locator(".readout dl > div", { hasText: "Integrator" });
    return (await row.locator("dd").textContent()) ?? "";
  };

  it("is chosen by name or by wish, and the frame says what was used", async () => {
    await model("Volume");
    await client.page.getByText("By name").click();
    const choice = setting("Integrator");
    await expect
      .poll(() => choice.locator("option").allTextContents())
      .toEqual([
        "As the wish asks",
        "Average",
        "Linear opacity",
        "Psi, from a table",
        "Psi, closed form",
        "Pre-integrated",
        "Exact",
      ]);
    for (const [label, name] of [
      ["Exact", "exact"],
      ["Average", "average"],
    ] as const) {
      await choose("Integrator", label);
      expect(await integrator()).toBe(name);
    }
    await choose("Integrator", "As the wish asks");
    await choose("Wish", "Exact");
    expect(await integrator()).toBe("exact");
    await model("X-ray");
    await expect.poll(() => choice.locator("option").count()).toBe(4);
  });
});

describe("what the server refuses", () => {
  const note = () => client.page.locator(".refusal");

  it("is told in a sentence, and the picture stays as it was", async () => {
    await model("Isosurface");
    await choose("Levels", "List");
    const before = await picture();
    await type("Values", "");
    await note().waitFor();
    await expect
      .poll(() => note().textContent())
      .toContain("Levels: an isosurface needs at least one level.");
    await expect.poll(() => setting("Values").getAttribute("aria-invalid")).toBe("true");
    expect(await client.badge()).toBe("refused");
    // On a busy machine the browser may still be painting what was there before the refusal.
    await expect.poll(picture, { timeout: 20_000 }).toBe(before);
    await client.page.getByRole("button", { name: "Take back" }).click();
    await client.settled();
    await expect.poll(() => note().count()).toBe(0);
    await expect.poll(picture, { timeout: 20_000 }).toBe(before);
  });

  it("is forgotten when the setting is mended, and never kept by a reload", async () => {
    await model("X-ray");
    const before = await picture();
    await type("Strength, times the map’s", "-1");
    await note().waitFor();
    await client.page.reload();
    await client.settled();
    await expect
      .poll(() => client.page.getByRole("radio", { name: "X-ray" }).isChecked())
      .toBe(true);
    expect(await picture()).toBe(before);
    await type("Strength, times the map’s", "-1");
    await note().waitFor();
    await client.page.locator(".picture").focus();
    await client.page.keyboard.press("ArrowLeft");
    await client.page.keyboard.press("ArrowRight");
    await expect.poll(() => note().count()).toBe(1);
    await client.after(() => type("Strength, times the map’s", "2"));
    await expect.poll(() => note().count()).toBe(0);
    expect(await picture()).not.toBe(before);
    expect(client.complaints).toEqual([]);
  });
});

describe("a reload", () => {
  it("keeps model, levels, planes and accuracy", async () => {
    await model("Isosurface");
    await choose("Levels", "Even steps");
    await client.after(() => client.page.getByRole("button", { name: "Add a clip plane" }).click());
    await choose("Wish", "Fastest");
    const before = await picture();
    await client.page.reload();
    await client.settled();
    expect(await picture()).toBe(before);
    await expect.poll(() => setting("Levels").inputValue()).toBe("linear");
    await expect.poll(() => client.page.locator(".plane").count()).toBe(1);
  });
});
