import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import { decodeFrame, type Frame, isFrame } from "../../../web_client/src/net/framing";
import { Codec } from "../../../web_client/src/net/gen/volcast/v1/frame_pb";
import { decodePng, type Pixels } from "./pixels";

const kPatienceMs = 60_000;

/** The client in a page of its own, and all that the server sent to it. */
export class Client {
  readonly page: Page;
  readonly complaints: string[] = [];
  /** The newest lossless frame that came over the wire. */
  lossless: Frame | undefined;
  /** Colour patches that came over the wire. */
  readonly patches: Frame[] = [];

  private constructor(page: Page) {
    this.page = page;
    page.on("pageerror", (error) => this.complaints.push(error.message));
    page.on("websocket", (socket) => {
      socket.on("framereceived", ({ payload }) => {
        if (typeof payload === "string") return;
        const bytes = Uint8Array.from(payload);
        if (!isFrame(bytes)) return;
        const frame = decodeFrame(bytes);
        if (frame.header.lossless) this.lossless = frame;
        if (frame.header.patch) this.patches.push(frame);
      });
    });
  }

  /** Opens the page and waits for its first exact picture. */
  static async open(
    browser: Browser,
    url: string,
    options: BrowserContextOptions = {},
  ): Promise<Client> {
    const client = await Client.visit(browser, url, options);
    await client.settled();
    return client;
  }

  /** Opens the page and waits for nothing more. */
  static async visit(
    browser: Browser,
    url: string,
    options: BrowserContextOptions = {},
  ): Promise<Client> {
    const context = await browser.newContext({
      viewport: { width: 1000, height: 600 },
      ...options,
    });
    const client = new Client(await context.newPage());
    await client.page.goto(url);
    return client;
  }

  async close(): Promise<void> {
    await this.page.context().close();
  }

  badge(): Promise<string> {
    return this.page.evaluate(
      () => document.querySelector<HTMLElement>(".badge")?.dataset.state ?? "",
    );
  }

  async waitForBadge(state: string): Promise<void> {
    await this.page.waitForSelector(`.badge[data-state="${state}"]`, {
      state: "attached",
      timeout: kPatienceMs,
    });
  }

  /** A fact about the picture on the screen, from the element that holds it. */
  async fact(
    name: "inputSeq" | "lossless" | "exact" | "codec" | "view" | "size" | "workerGeneration",
  ) {
    return this.page.evaluate(
      (key) => document.querySelector<HTMLElement>(".picture")?.dataset[key] ?? "",
      name,
    );
  }

  /** Waits for the exact picture of an input after `after`. */
  async settled(after = 0): Promise<void> {
    await this.page.waitForFunction(
      (seq) => {
        const picture = document.querySelector<HTMLElement>(".picture")?.dataset;
        const badge = document.querySelector<HTMLElement>(".badge")?.dataset;
        return Number(picture?.inputSeq ?? 0) > seq && badge?.state === "final";
      },
      after,
      { timeout: kPatienceMs },
    );
  }

  /** Waits for the exact picture of somebody else's view, of an input after `after`. */
  async watched(after = 0): Promise<void> {
    await this.page.waitForFunction(
      (seq) => {
        const picture = document.querySelector<HTMLElement>(".picture")?.dataset;
        const badge = document.querySelector<HTMLElement>(".badge");
        const exact = badge?.textContent?.includes("Watching, exact");
        return Number(picture?.inputSeq ?? 0) > seq && exact;
      },
      after,
      { timeout: kPatienceMs },
    );
  }

  /** Does something to the view and waits for the exact picture of it. */
  async after(act: () => Promise<void>): Promise<void> {
    const before = Number(await this.fact("inputSeq"));
    await act();
    await this.settled(before);
  }

  /** Shows a dataset, if it is not shown. */
  async choose(dataset: string): Promise<void> {
    const row = this.page.locator(`.dataset[data-dataset="${dataset}"]`);
    if ((await row.getAttribute("data-shown")) !== null) return;
    await this.after(() => row.locator(".dataset-choose").click());
  }

  /** What is on the screen where a view's picture is: composited, in device pixels. */
  async pixels(view = 0): Promise<Pixels> {
    await this.#coverPicture("hidden");
    const png = await this.page.locator(".picture").nth(view).screenshot();
    await this.#coverPicture("");
    return decodePng(png);
  }

  /** The newest lossless picture that came: a PNG by our own decoder, a WebP by the page's. */
  async sent(): Promise<Pixels> {
    if (!this.lossless) throw new Error("no lossless frame came over the wire");
    const { header, payload } = this.lossless;
    if (header.codec === Codec.PNG) return decodePng(payload);
    const base64 = Buffer.from(payload).toString("base64");
    const { width, height, data } = await this.page.evaluate(async (text) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/webp" }));
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
      if (!context) throw new Error("the page has no 2D canvas");
      context.drawImage(bitmap, 0, 0);
      const pixels = context.getImageData(0, 0, bitmap.width, bitmap.height).data;
      let packed = "";
      for (const byte of pixels) packed += String.fromCharCode(byte);
      return { width: bitmap.width, height: bitmap.height, data: btoa(packed) };
    }, base64);
    return { width, height, data: Uint8Array.from(Buffer.from(data, "base64")) };
  }

  /** Shows or hides what lies over the picture; the page's policy allows no style of ours. */
  async #coverPicture(visibility: "hidden" | ""): Promise<void> {
    await this.page.evaluate((value) => {
      for (const part of document.querySelectorAll<HTMLElement>(
        ".tools, .readout, .picked, .notices, .overlay, .hud, .difference, .pane-head, .pane-frame, .panes-link",
      )) {
        part.style.visibility = value;
      }
      for (const picture of document.querySelectorAll<HTMLElement>(".picture")) {
        picture.style.outline = value ? "none" : "";
      }
    }, visibility);
  }

  /** The middle of the picture in CSS pixels. */
  async middle(): Promise<{ x: number; y: number }> {
    const box = await this.page.locator(".picture").boundingBox();
    if (!box) throw new Error("the picture has no box");
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  }

  async drag(dx: number, dy: number, steps = 8): Promise<void> {
    const { x, y } = await this.middle();
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    await this.page.mouse.move(x + dx, y + dy, { steps });
    await this.page.mouse.up();
  }
}
