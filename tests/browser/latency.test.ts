import { describe, expect, it } from "vitest";
import { percentile } from "../../web_client/src/state/latencies";
import type { Stages } from "../../web_client/src/state/recorder";
import { setUp } from "./support/set_up";

const place = setUp({ data: process.env.VOLCAST_LATENCY_DATA });

const kPanel = 336;
const kWanted = 60;
const kLongestMs = 8_000;

interface Diagnostics {
  volcast: {
    latencies(): readonly number[];
    stages(): readonly Stages[];
    clearLatencies(): void;
  };
}

const kStages = ["wait", "upload", "draw", "readback", "encode", "queue", "decode"] as const;

/** Printed for the reader, not judged: a busy machine is no bug. */
describe("latency", () => {
  it.each([512, 1024])("input to drawn at %s squared is measured", async (side) => {
    const client = await place.open({
      viewport: { width: side + kPanel, height: side },
    });
    expect(await client.fact("size")).toBe(`${side}x${side}`);
    const { page } = client;
    await page.evaluate(() => (window as unknown as Diagnostics).volcast.clearLatencies());
    const latencies = () =>
      page.evaluate(() => (window as unknown as Diagnostics).volcast.latencies());
    await client.after(async () => {
      const { x, y } = await client.middle();
      const end = performance.now() + kLongestMs;
      await page.mouse.move(x, y);
      await page.mouse.down();
      for (let i = 1; performance.now() < end; i += 1) {
        await page.mouse.move(x + 100 * Math.sin(i / 20), y + 60 * Math.sin(i / 13));
        if (i % 20 === 0 && (await latencies()).length >= kWanted) break;
      }
      await page.mouse.up();
    });
    const ms = await latencies();
    expect(ms.length).toBeGreaterThan(0);
    const show = (p: number): string => (percentile(ms, p) ?? Number.NaN).toFixed(1);
    console.info(
      `input to drawn at ${side}x${side}: p50 ${show(0.5)} ms, p95 ${show(0.95)} ms, ${ms.length} inputs`,
    );
    const pictures = await page.evaluate(() => (window as unknown as Diagnostics).volcast.stages());
    expect(pictures.length).toBeGreaterThan(0);
    const medians = kStages.map((stage) => {
      const median = percentile(
        pictures.map((picture) => picture[stage]),
        0.5,
      );
      return `${stage} ${(median ?? Number.NaN).toFixed(2)}`;
    });
    console.info(`  median ms by stage of ${pictures.length} pictures: ${medians.join(", ")}`);
    await client.close();
  });
});
