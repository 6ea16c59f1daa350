import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, BrowserContextOptions } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, expect } from "vitest";
import { sharedBrowser } from "./browser";
import { Client } from "./client";
import { Server } from "./server";

interface Wanted {
  /** A folder to serve, or what writes into one of this file's; none: the built-in demo is served. */
  readonly data?: string | ((folder: string) => void) | undefined;
  /** More arguments of the server. */
  readonly more?: readonly string[];
  /** What pages are opened with. */
  readonly page?: BrowserContextOptions;
}

/** A server of the file's own, and pages in the browser of all files. */
export class Place {
  readonly #page: BrowserContextOptions;
  readonly #clients: Client[] = [];
  server!: Server;
  browser!: Browser;
  /** What is served; "" where that is the built-in demo. */
  folder = "";

  constructor(page: BrowserContextOptions) {
    this.#page = page;
  }

  get url(): string {
    return this.server.url;
  }

  get clients(): number {
    return this.#clients.length;
  }

  /** A page with its first exact picture. */
  async open(options: BrowserContextOptions = {}, url = this.url): Promise<Client> {
    const client = await this.visit(options, url);
    await client.settled();
    return client;
  }

  /** A page of which nothing is waited for. */
  async visit(options: BrowserContextOptions = {}, url = this.url): Promise<Client> {
    const client = await Client.visit(this.browser, url, { ...this.#page, ...options });
    this.#clients.push(client);
    return client;
  }

  /** Closes the pages after the first `kept`; one that complained fails the test. */
  async close(kept: number): Promise<void> {
    const closed = this.#clients.splice(kept);
    for (const client of closed) await client.close();
    expect(closed.flatMap((client) => client.complaints)).toEqual([]);
  }
}

/** Begins a server before the file's tests. Pages that a test opens end with it, those of `beforeAll` with the file. */
export function setUp({ data, more, page = {} }: Wanted = {}): Place {
  const place = new Place(page);
  let kept = 0;
  beforeAll(async () => {
    if (typeof data === "function") {
      place.folder = mkdtempSync(join(tmpdir(), "volcast-data-"));
      data(place.folder);
    }
    place.server = await Server.start({
      ...(data ? { data: typeof data === "string" ? data : place.folder } : {}),
      ...(more ? { more } : {}),
    });
    place.browser = await sharedBrowser();
  });
  beforeEach(() => {
    kept = place.clients;
  });
  afterEach(() => place.close(kept));
  afterAll(async () => {
    await place.close(0);
    await place.server?.stop();
    if (place.folder) rmSync(place.folder, { recursive: true, force: true });
  });
  return place;
}
