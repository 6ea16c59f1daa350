import { describe, expect, it } from "vitest";
import { LatestQueue } from "./latest_queue";

describe("latest queue", () => {
  it("works on one, keeps the newest waiting and reports the others", async () => {
    const done: number[] = [];
    const dropped: number[] = [];
    const releases: (() => void)[] = [];
    const queue = new LatestQueue<number>(
      (item) =>
        new Promise((resolve) => {
          releases.push(() => {
            done.push(item);
            resolve();
          });
        }),
      (item) => dropped.push(item),
    );
    const running = queue.push(1);
    void queue.push(2);
    void queue.push(3);
    void queue.push(4);
    expect(dropped).toEqual([2, 3]);
    expect(queue.waiting).toBe(1);
    releases.shift()?.();
    await Promise.resolve();
    expect(queue.waiting).toBe(0);
    releases.shift()?.();
    await running;
    expect(done).toEqual([1, 4]);
    void queue.push(5);
    expect(releases).toHaveLength(1);
  });
});
