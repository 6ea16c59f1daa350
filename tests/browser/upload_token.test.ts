import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { writeBall } from "./support/data";
import { findProgram } from "./support/server";
import { setUp } from "./support/set_up";

const mine = mkdtempSync(join(tmpdir(), "volcast-mine-"));
const key = join(mine, "link.key");
const place = setUp({
  data: (folder) => writeBall(folder, "first", 8),
  more: ["--allow-uploads", "--uploads-need-token", "--link-key-file", key],
});

beforeAll(() => writeBall(mine, "ball", 12));
afterAll(() => rmSync(mine, { recursive: true, force: true }));

/** As whoever runs the server prints it. */
function token(role: "control" | "watch"): string {
  const printed = execFileSync(findProgram(), ["token", "--key-file", key, "--role", role]);
  return printed.toString().trim();
}
const withToken = (access: string): Promise<Client> =>
  place.open({}, `${place.url}#access=${access}`);
const button = (of: Client) => of.page.getByRole("button", { name: "Upload data" });
const row = (of: Client) => of.page.locator('.dataset[data-dataset="uploads/ball/ball.mhd"]');

describe("a server that takes uploads by token", () => {
  it("offers them to nobody else", async () => {
    expect(await button(await place.open()).count()).toBe(0);
    expect(await button(await withToken(token("watch"))).count()).toBe(0);
  });

  it("says that a token is none, and shows its data all the same", async () => {
    const client = await withToken("A-forged");
    expect(await button(client).count()).toBe(0);
    await expect.poll(() => client.page.locator(".notice").allInnerTexts()).not.toEqual([]);
    expect((await client.page.locator(".notice").allInnerTexts()).join()).toMatch(/access token/);
  });

  it("takes them from who has one; the address forgets it, and a reload does not", async () => {
    const client = await withToken(token("control"));
    await button(client).waitFor();
    expect(client.page.url()).not.toContain("access");
    await client.after(async () => {
      const files = [join(mine, "ball.mhd"), join(mine, "ball.raw")];
      await client.page.locator(".upload-input").setInputFiles(files);
      await row(client).and(client.page.locator("[data-shown]")).waitFor();
    });
    await client.page.reload();
    await client.settled();
    await button(client).waitFor();
    const other = await place.open();
    await row(other).waitFor();
    expect(await button(other).count()).toBe(0);
  });
});
