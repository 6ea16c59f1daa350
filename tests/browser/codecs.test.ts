import { beforeAll, describe, expect, it } from "vitest";
import { Codec } from "../../web_client/src/net/gen/volcast/v1/frame_pb";
import { xxh32 } from "../../web_client/src/video/xxh32";
import type { Client } from "./support/client";
import { setUp } from "./support/set_up";

const place = setUp();
let client: Client;

beforeAll(async () => {
  client = await place.open({ viewport: { width: 760, height: 480 } });
});

describe("codecs", () => {
  it("shows a final picture whose pixels have the server's hash", async () => {
    const frame = client.lossless;
    expect(frame).toBeDefined();
    if (!frame) return;
    expect(frame.header.pixelsXxh32).not.toBe(0);
    // By the test's decoder, and by the page's.
    expect(xxh32((await client.sent()).data)).toBe(frame.header.pixelsXxh32);
    expect(await client.fact("exact")).toBe("true");
    const label = await client.page.evaluate(() => document.querySelector(".badge")?.textContent);
    expect(label).toContain("Final, exact");
  });

  it("decodes the colour patches of every codec that both sides have", async () => {
    const tried = await client.page.evaluate(() => typeof VideoDecoder !== "undefined");
    expect(tried).toBe(true); // 127.0.0.1 is a secure origin.
    const sent = client.patches.map((patch) => patch.header.codec);
    expect(sent).toContain(Codec.VP9);
    await expect.poll(() => place.server.patches().length, { timeout: 30_000 }).toBe(sent.length);
    for (const line of place.server.patches()) console.info(line);
    expect(place.server.patches().find((line) => line.includes("CODEC_VP9"))).toContain(
      "passed=true",
    );
  });

  it("draws a view by each video codec that passed, and its exact picture after it", async () => {
    await client.page.evaluate(() => {
      const seen: string[] = [];
      Object.assign(window, { seenCodecs: seen });
      const picture = document.querySelector<HTMLElement>(".picture");
      if (!picture) return;
      const look = (): void => void seen.push(picture.dataset.codec ?? "");
      new MutationObserver(look).observe(picture, { attributeFilter: ["data-sequence"] });
    });
    for (const codec of [Codec.VP9, Codec.H264]) {
      const line = place.server.patches().find((one) => one.includes(`CODEC_${Codec[codec]}`));
      if (!line?.includes("passed=true")) {
        console.info(`not shown here: ${Codec[codec]}`);
        continue;
      }
      await client.page.evaluate((wanted) => window.volcast.setPins({ codec: wanted }), codec);
      await client.after(() => client.drag(90, 20));
      const seen = await client.page.evaluate(
        () => (window as unknown as { seenCodecs: string[] }).seenCodecs,
      );
      expect(seen).toContain(Codec[codec]);
      expect(await client.fact("exact")).toBe("true");
      expect(client.complaints).toEqual([]);
    }
  });
});
