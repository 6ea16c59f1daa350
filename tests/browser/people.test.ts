import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { violations } from "./support/accessibility";
import type { Client } from "./support/client";
import { Cuttable } from "./support/cuttable";
import { hashOf } from "./support/pixels";
import { Server, screenshotFolder } from "./support/server";
import { setUp } from "./support/set_up";

const kSize = { viewport: { width: 760, height: 600 } };

const place = setUp({ page: kSize });

const open = (url = place.url, options = {}): Promise<Client> => place.open(options, url);

async function joined(link: string, options = {}): Promise<Client> {
  const client = await place.visit(options, link);
  await client.watched();
  return client;
}

async function openShare({ page }: Client): Promise<void> {
  await page.getByRole("button", { name: "Share", exact: true }).click();
  await page.getByRole("heading", { name: "In this view" }).waitFor();
}

const closeShare = ({ page }: Client): Promise<void> => page.keyboard.press("Escape");

/** A link to the client's view, made and read as a person does it. */
async function linkTo(client: Client, role: "watch" | "steer, in turns"): Promise<string> {
  const { page } = client;
  await openShare(client);
  await page.getByLabel("Whoever has it may").selectOption({ label: role });
  await page.getByRole("button", { name: /Make a(nother)? link/ }).click();
  const field = page.getByRole("textbox", {
    name: role === "watch" ? "Link to watch" : "Link to steer",
  });
  await field.waitFor();
  const link = await field.inputValue();
  await closeShare(client);
  return link;
}

async function rename(client: Client, name: string): Promise<void> {
  await openShare(client);
  const field = client.page.getByLabel("Your name");
  await field.fill(name);
  await field.press("Enter");
  await client.page.locator(".person-name", { hasText: name }).waitFor();
  await closeShare(client);
}

const picture = async (client: Client): Promise<string> => hashOf(await client.pixels());

async function waitForSamePicture(follower: Client, steering: Client): Promise<void> {
  await follower.watched(Number(await steering.fact("inputSeq")) - 1);
  expect(await picture(follower)).toBe(await picture(steering));
}

const names = ({ page }: Client): Promise<string[]> => page.locator(".person").allInnerTexts();

describe("two in one view", () => {
  it("see the same, the watcher too when the other one moves", async () => {
    const ann = await open();
    await rename(ann, "Ann");
    const ben = await joined(await linkTo(ann, "watch"));
    expect(await picture(ben)).toBe(await picture(ann));
    const before = await picture(ben);
    await ann.after(() => ann.drag(140, -40));
    await waitForSamePicture(ben, ann);
    expect(await picture(ben)).not.toBe(before);
  });

  it("tell a watcher why nothing can be changed, and let nothing be changed", async () => {
    const ann = await open();
    await rename(ann, "Ann");
    const ben = await joined(await linkTo(ann, "watch"));
    const before = await picture(ben);
    const why = /Ann steers this view\. Ask for control to change it\./;
    await expect.poll(() => ben.page.locator(".steer-note").innerText()).toMatch(why);
    const reset = ben.page.getByRole("button", { name: "Show everything" });
    await expect.poll(() => reset.getAttribute("aria-disabled")).toBe("true");
    await expect.poll(() => reset.getAttribute("title")).toMatch(why);
    for (const name of ["Volume", "Surface"]) {
      await expect
        .poll(() => ben.page.getByRole("radio", { name, exact: true }).isDisabled())
        .toBe(true);
    }
    await ben.drag(90, 20);
    await ben.page.locator(".notice", { hasText: why }).waitFor();
    await ben.page.keyboard.press("x");
    await ben.watched();
    expect(await picture(ben)).toBe(before);
    expect(await picture(ann)).toBe(before);
  });

  it("hand control over when it is asked for, and take it back", async () => {
    const ann = await open();
    await rename(ann, "Ann");
    const ben = await joined(await linkTo(ann, "watch"));
    await rename(ben, "Ben");
    await ben.page.locator(".steer-note").getByRole("button", { name: "Ask for control" }).click();
    await ann.page.locator(".notice", { hasText: "Ben asks for control" }).waitFor();
    await openShare(ann);
    await expect
      .poll(() => names(ann))
      .toEqual([
        expect.stringMatching(/Ann\s+you, steers/),
        expect.stringMatching(/Ben\s+watches, asks for control/),
      ]);
    await ann.page.getByRole("button", { name: "Hand over to Ben" }).click();
    await ben.settled();
    await closeShare(ann);
    await ben.after(() => ben.drag(-80, 60));
    await waitForSamePicture(ann, ben);
    await ann.page.locator(".steer-note").getByRole("button", { name: "Take control" }).click();
    await ann.settled();
    await ann.after(() => ann.drag(30, 0));
    await waitForSamePicture(ben, ann);
  });

  it("undo what anybody did, by one history", async () => {
    const ann = await open();
    const ben = await joined(await linkTo(ann, "steer, in turns"));
    const before = await picture(ann);
    const surface = { name: "Surface", exact: true };
    await ann.after(() => ann.page.getByRole("radio", surface).check({ force: true }));
    await waitForSamePicture(ben, ann);
    const after = await picture(ben);
    expect(after).not.toBe(before);
    await ben.page.locator(".steer-note").getByRole("button", { name: "Take control" }).click();
    await ben.settled();
    await ben.after(() => ben.page.getByRole("button", { name: "Undo" }).click());
    expect(await picture(ben)).toBe(before);
    await waitForSamePicture(ann, ben);
    await ben.after(() => ben.page.keyboard.press("Control+Shift+Z"));
    expect(await picture(ben)).toBe(after);
    const redo = ben.page.getByRole("button", { name: "Redo" });
    await expect.poll(() => redo.isDisabled()).toBe(true);
  });

  it("go to other data together", async () => {
    const ann = await open();
    const ben = await joined(await linkTo(ann, "watch"));
    const row = ann.page.locator(".dataset:not([data-shown])").first();
    const name = await row.locator(".dataset-name").innerText();
    await ann.after(() => row.locator(".dataset-choose").click());
    await waitForSamePicture(ben, ann);
    await expect
      .poll(() => ben.page.locator(".dataset[data-shown] .dataset-name").innerText())
      .toBe(name);
  });

  it("list a person once who has the view twice on one page, and another page as another person", async () => {
    const ann = await open();
    await rename(ann, "Ann");
    const link = await linkTo(ann, "steer, in turns");
    const ben = await place.visit({}, `${link}&${link.split("#")[1]}`);
    for (const view of [0, 1]) {
      const picture = ben.page.locator('.picture[data-exact="true"]').nth(view);
      await picture.waitFor({ timeout: 60_000 });
    }
    await rename(ben, "Ben");
    await openShare(ann);
    const once = [
      expect.stringMatching(/Ann\s+you, steers/),
      expect.stringMatching(/Ben\s+may steer/),
    ];
    await expect.poll(() => names(ann)).toEqual(once);
    const note = ben.page.locator(".steer-note");
    await ben.page.getByRole("button", { name: /^1: / }).click();
    await note.getByRole("button", { name: "Take control" }).click();
    await expect
      .poll(() => names(ann))
      .toEqual([expect.stringMatching(/Ann\s+you, may/), expect.stringMatching(/Ben\s+steers/)]);
    await ben.page.getByRole("button", { name: /^2: / }).click();
    await expect.poll(() => note.innerText()).toMatch(/You steer this view beside this one/);
    await note.getByRole("button", { name: "Take control" }).click();
    await note.waitFor({ state: "detached" });
    await joined(link);
    await expect.poll(() => names(ann)).toHaveLength(3);
  });

  it("let a watcher look around in a view beside, which follows until it is moved", async () => {
    const ann = await open();
    const ben = await joined(await linkTo(ann, "watch"));
    await openShare(ben);
    await ben.page.getByRole("button", { name: "Look around beside it" }).click();
    await closeShare(ben);
    await ben.page.locator(".picture").nth(1).waitFor();
    await ben.settled();
    const own = hashOf(await ben.pixels(1));
    const second = ben.page.locator(".picture").nth(1);
    const before = Number(await second.getAttribute("data-input-seq"));
    await ann.after(() => ann.drag(100, 0));
    await ben.page.waitForFunction((seq) => {
      const [, picture] = document.querySelectorAll<HTMLElement>(".picture");
      return Number(picture?.dataset.inputSeq) > seq && picture?.dataset.exact === "true";
    }, before);
    await ben.settled();
    expect(hashOf(await ben.pixels(1))).not.toBe(own);
  });
});

describe("coming back", () => {
  it("keeps the seat over a reload, and a watcher watching", async () => {
    const ann = await open();
    await rename(ann, "Ann");
    const ben = await joined(await linkTo(ann, "watch"));
    await rename(ben, "Ben");
    await ann.after(() => ann.drag(70, 10));
    await ben.page.reload();
    await ben.watched();
    await ann.page.reload();
    await ann.settled();
    await openShare(ann);
    await expect
      .poll(async () => (await names(ann)).sort())
      .toEqual([
        expect.stringMatching(/Ann\s+you, steers/),
        expect.stringMatching(/Ben\s+watches/),
      ]);
    await closeShare(ann);
    await ann.after(() => ann.drag(10, 10));
    await waitForSamePicture(ben, ann);
  });

  it("goes on after the way was cut, with what was done meanwhile", async () => {
    const way = await Cuttable.to(place.server.port);
    const ann = await open(way.url);
    const ben = await joined((await linkTo(ann, "watch")).replace(way.url, place.url));
    const before = await picture(ann);
    const view = await ann.fact("view");
    const seen = Number(await ann.fact("inputSeq"));
    way.cut();
    await ann.waitForBadge("reconnecting");
    await ann.drag(120, 30);
    way.mend();
    await ann.page
      .getByRole("button", { name: "Now" })
      .click({ timeout: 2000 })
      .catch(() => {});
    await ann.settled(seen);
    expect(await picture(ann)).not.toBe(before);
    expect(await ann.fact("view")).toBe(view);
    await waitForSamePicture(ben, ann);
    await way.close();
  });

  it("outlives a server that keeps its views, for everybody in them", async () => {
    const folder = mkdtempSync(join(tmpdir(), "volcast-state-"));
    const more = ["--state-dir", folder];
    let own = await Server.start({ more });
    const ann = await open(own.url);
    const ben = await joined(await linkTo(ann, "watch"));
    await ann.after(() => ann.drag(-60, 25));
    const before = await picture(ann);
    const view = await ann.fact("view");
    const { port } = own;
    await own.stop();
    await ann.waitForBadge("reconnecting");
    own = await Server.start({ port, more });
    await ann.waitForBadge("final");
    expect(await picture(ann)).toBe(before);
    expect(await ann.fact("view")).toBe(view);
    await ben.watched();
    await ann.after(() => ann.drag(20, 0));
    await waitForSamePicture(ben, ann);
    await own.stop();
    rmSync(folder, { recursive: true, force: true });
  });

  it("leaves everybody what they saw where the server forgot", async () => {
    let own = await Server.start();
    const ann = await open(own.url);
    const ben = await joined(await linkTo(ann, "watch"));
    await ann.after(() => ann.drag(-60, 25));
    await waitForSamePicture(ben, ann);
    const before = await picture(ann);
    const { port } = own;
    await own.stop("SIGKILL");
    await ann.waitForBadge("reconnecting");
    await ben.waitForBadge("reconnecting");
    own = await Server.start({ port });
    await ann.settled();
    await ben.settled();
    expect(await picture(ann)).toBe(before);
    expect(await picture(ben)).toBe(before);
    await ben.page.locator(".notice", { hasText: "copy" }).waitFor();
    await ben.after(() => ben.drag(15, 0));
    await own.stop();
  });

  it("says that a link is no good, and shows something all the same", async () => {
    const client = await place.open({}, `${place.url}#link=AAAA`);
    await client.page.locator(".notice", { hasText: /link/ }).waitFor();
  });
});

describe("the dialog", () => {
  it.each([
    { name: "1280-light", viewport: { width: 1280, height: 800 }, colorScheme: "light" as const },
    { name: "390-dark", viewport: { width: 390, height: 844 }, colorScheme: "dark" as const },
  ])("$name is accessible and is photographed", async ({ name, ...options }) => {
    const ann = await open(place.url, options);
    await rename(ann, "Ann");
    const ben = await joined(await linkTo(ann, "watch"), options);
    await rename(ben, "Ben");
    await openShare(ann);
    for (const client of [ann, ben]) {
      expect(await violations(client)).toEqual([]);
    }
    const shot = (client: Client, what: string): Promise<Buffer> =>
      client.page.screenshot({ path: join(screenshotFolder(), `${name}-${what}.png`) });
    await shot(ann, "share");
    await shot(ben, "watching");
    await openShare(ben);
    expect(await violations(ben)).toEqual([]);
    await shot(ben, "share-watching");
    const { page } = ann;
    const dialog = page.locator("dialog.share");
    expect(await dialog.evaluate((e) => e.scrollWidth - e.clientWidth)).toBe(0);
  });

  it("copies a link on a page that has no clipboard of its own", async () => {
    const ann = await open();
    await ann.page.evaluate(() => {
      Object.defineProperty(navigator, "clipboard", { value: undefined });
      document.addEventListener("copy", () => {
        Object.assign(window, { copied: String(window.getSelection()) });
      });
    });
    await openShare(ann);
    const { page } = ann;
    await page.getByRole("button", { name: "Copy: Address of this picture" }).click();
    await page.getByText("Copied").waitFor();
    const copied = await page.evaluate(() => (window as unknown as { copied: string }).copied);
    expect(copied).toContain("#view=");
  });
});
