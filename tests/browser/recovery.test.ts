import { beforeAll, describe, expect, it } from "vitest";
import type { Client } from "./support/client";
import { hashOf } from "./support/pixels";
import { Server } from "./support/server";
import { setUp } from "./support/set_up";

const place = setUp({ more: ["--frame-deadline-ms", "4000"] });
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 480 } });
  await client.page.evaluate(() => {
    const badge = document.querySelector<HTMLElement>(".badge");
    const seen: string[] = [];
    Object.assign(window, { seenBadges: seen });
    if (!badge) return;
    const look = (): void => void seen.push(badge.dataset.state ?? "");
    new MutationObserver(look).observe(badge, { attributeFilter: ["data-state"] });
  });
});

const generation = async (): Promise<number> => Number(await client.fact("workerGeneration"));

async function seenBadges(): Promise<string[]> {
  return client.page.evaluate(() => (window as unknown as { seenBadges: string[] }).seenBadges);
}

async function waitForGenerationAfter(before: number): Promise<void> {
  await client.page.waitForFunction(
    (old) => {
      const now = document.querySelector<HTMLElement>(".picture")?.dataset.workerGeneration;
      return Number(now) > old;
    },
    before,
    { timeout: 60_000 },
  );
  await client.waitForBadge("final");
}

describe("recovery", () => {
  it("draws the same picture after its worker was killed", async () => {
    await client.after(() => client.drag(110, -30));
    const before = hashOf(await client.pixels());
    const old = await generation();
    const workers = place.server.workers();
    expect(workers.length).toBeGreaterThan(0);
    const killedAt = performance.now();
    for (const pid of workers) process.kill(pid, "SIGKILL");
    await waitForGenerationAfter(old);
    const ms = performance.now() - killedAt;
    console.info(`SIGKILL of all workers to the next exact picture: ${ms.toFixed(0)} ms`);
    expect(hashOf(await client.pixels())).toBe(before);
    expect(await seenBadges()).toContain("recovering");
  });

  it("goes on taking input afterwards", async () => {
    const before = hashOf(await client.pixels());
    await client.after(() => client.drag(-60, 10));
    expect(hashOf(await client.pixels())).not.toBe(before);
  });

  it("survives a worker that stops answering", async () => {
    const old = await generation();
    for (const pid of place.server.workers()) process.kill(pid, "SIGSTOP");
    await client.after(() => client.drag(50, 25));
    expect(await generation()).toBeGreaterThan(old);
  });

  it("reconnects to a restarted server with everything as it was", async () => {
    const density = client.page.getByRole("slider", { name: "Density" });
    if ((await density.count()) > 0) await client.after(() => density.fill("0.4"));
    const before = hashOf(await client.pixels());
    const { port } = place.server;
    await place.server.stop("SIGKILL");
    await client.waitForBadge("reconnecting");
    const label = await client.page.locator(".badge").textContent();
    expect(label).toMatch(/Reconnecting in \d+ s/);
    place.server = await Server.start({ port });
    await client.page.waitForSelector('.badge[data-state="final"]', { timeout: 60_000 });
    expect(hashOf(await client.pixels())).toBe(before);
    expect(client.complaints).toEqual([]);
  });
});
