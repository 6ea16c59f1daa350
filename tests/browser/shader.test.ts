import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Client, launch } from "./support/client";
import { hashOf } from "./support/pixels";
import { Server } from "./support/server";

let server: Server;
let browser: Browser;
let client: Client;

beforeAll(async () => {
  server = await Server.start();
  browser = await launch();
  client = await Client.open(browser, server.url, { viewport: { width: 1000, height: 900 } });
  const row = client.page.locator('.dataset[data-dataset="demo:volume"]');
  if ((await row.getAttribute("data-shown")) === null) {
    await client.after(() => row.locator(".dataset-choose").click());
  }
  await client.page.locator("section", { hasText: "Shader" }).locator("summary").click();
});

afterAll(async () => {
  await browser?.close();
  await server?.stop();
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
      () => client.page.getByLabel("tint").fill("#0000ff"),
      () => client.page.getByRole("slider", { name: "strength" }).fill("0.9"),
      () => client.page.getByLabel("turned").check(),
      async () => {
        await client.page
          .getByRole("combobox", { name: "part", exact: true })
          .selectOption({ label: "half" });
      },
      async () => {
        await client.page.getByLabel("range, 1 at").fill("0.5");
        await client.page.getByLabel("range, 1 at").press("Enter");
      },
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
    expect(await client.page.getByLabel("turned").isChecked()).toBe(true);
    await client.page.locator("section", { hasText: "Shader" }).locator("summary").click();
    await client.after(() => client.page.getByRole("button", { name: "Use the map" }).click());
    expect(await picture()).toBe(byMap);
    expect(await editor().inputValue()).toBe(kCode);
  });

  it("says by line what is wrong, and leaves the picture", async () => {
    const before = await picture();
    await editor().fill("void main() {\n  discard;\n}");
    await editor().press("Control+Enter");
    await complaints().first().waitFor();
    expect(await complaints().first().innerText()).toMatch(/^Line 2/);
    expect(await editor().getAttribute("aria-invalid")).toBe("true");
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
    expect(await note.innerText()).toMatch(/^Shader: line 2/);
    await client.page.getByRole("button", { name: "Take back" }).click();
    await client.settled();
    await expect.poll(picture, { timeout: 20_000 }).toBe(before);
    expect(await editor().inputValue()).toBe(wrong);
  });

  it("indents with Tab, and is left with Shift+Tab", async () => {
    await editor().fill("");
    await editor().press("Tab");
    expect(await editor().inputValue()).toBe("  ");
    await editor().press("Shift+Tab");
    expect(await editor().evaluate((e) => e === document.activeElement)).toBe(false);
  });
});
