import type { CDPSession } from "playwright-core";
import { beforeAll, beforeEach, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { difference, hashOf, type Pixels } from "./support/pixels";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;
let home: Pixels;

beforeAll(async () => {
  client = await place.open({
    viewport: { width: 760, height: 480 },
    hasTouch: true,
  });
  home = await client.pixels();
});

/** Every test starts from the first picture. */
beforeEach(async () => {
  if (hashOf(await client.pixels()) === hashOf(home)) return;
  await client.page.locator(".picture").focus();
  await client.after(() => client.page.keyboard.press("r"));
  expect(hashOf(await client.pixels())).toBe(hashOf(home));
});

async function expectChange(act: () => Promise<void>): Promise<Pixels> {
  await client.after(act);
  const now = await client.pixels();
  expect(difference(home, now).pixels).toBeGreaterThan(500);
  return now;
}

describe("camera by mouse", () => {
  it("turns by dragging", async () => {
    await expectChange(() => client.drag(150, 60));
  });

  it("pans by dragging with Shift or the right button, alike", async () => {
    const withShift = await expectChange(async () => {
      await client.page.keyboard.down("Shift");
      await client.drag(90, 30);
      await client.page.keyboard.up("Shift");
    });
    await client.after(() => client.page.keyboard.press("0"));
    const withRight = await expectChange(async () => {
      const { x, y } = await client.middle();
      await client.page.mouse.move(x, y);
      await client.page.mouse.down({ button: "right" });
      await client.page.mouse.move(x + 90, y + 30, { steps: 8 });
      await client.page.mouse.up({ button: "right" });
    });
    expect(hashOf(withRight)).toBe(hashOf(withShift));
  });

  it("dollies by the wheel and back by a double click", async () => {
    const { x, y } = await client.middle();
    await expectChange(async () => {
      await client.page.mouse.move(x + 40, y - 30);
      await client.page.mouse.wheel(0, -400);
    });
    await client.after(() => client.page.mouse.dblclick(x, y));
    expect(hashOf(await client.pixels())).toBe(hashOf(home));
  });
});

describe("camera by keyboard", () => {
  it.each(["ArrowRight", "ArrowUp", "Shift+ArrowLeft", "Equal", "Minus", "x", "2", "p"])(
    "%s changes the picture",
    async (key) => {
      await client.page.locator(".picture").focus();
      await expectChange(() => client.page.keyboard.press(key));
    },
  );

  it("switches the projection by its button too", async () => {
    const button = client.page.getByRole("button", { name: /^Perspective/ });
    await expectChange(() => button.click());
    await client.after(() => client.page.getByRole("button", { name: /^Orthographic/ }).click());
    expect(hashOf(await client.pixels())).toBe(hashOf(home));
  });

  it("opens the help and leaves the camera alone while it is open", async () => {
    const seq = await client.fact("inputSeq");
    await client.page.keyboard.press("Shift+Slash");
    await client.page.waitForSelector("dialog[open]");
    await client.page.keyboard.press("ArrowRight");
    await client.page.keyboard.press("Escape");
    await client.page.waitForSelector("dialog[open]", { state: "detached" });
    expect(await client.fact("inputSeq")).toBe(seq);
  });
});

describe("camera by touch", () => {
  let touch: CDPSession;

  const send = (type: "touchStart" | "touchMove" | "touchEnd", points: [number, number][]) =>
    touch.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map(([x, y], id) => ({ x, y, id })),
    });

  beforeAll(async () => {
    touch = await client.page.context().newCDPSession(client.page);
  });

  it("turns with one finger", async () => {
    const { x, y } = await client.middle();
    await expectChange(async () => {
      await send("touchStart", [[x, y]]);
      for (let i = 1; i <= 6; i += 1) await send("touchMove", [[x + 15 * i, y + 5 * i]]);
      await send("touchEnd", []);
    });
  });

  it("pinches with two fingers", async () => {
    const { x, y } = await client.middle();
    await expectChange(async () => {
      await send("touchStart", [
        [x - 40, y],
        [x + 40, y],
      ]);
      for (let i = 1; i <= 6; i += 1) {
        await send("touchMove", [
          [x - 40 - 10 * i, y],
          [x + 40 + 10 * i, y],
        ]);
      }
      await send("touchEnd", []);
    });
  });
});
