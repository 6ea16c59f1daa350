import { describe, expect, it } from "vitest";
import { changed, gestureEnded, redone, startHistory, undone } from "./history";

describe("history", () => {
  it("undoes and redoes step by step, and stays at its ends", () => {
    let h = changed(changed(startHistory("a"), "b"), "c");
    h = undone(h);
    expect(h.present).toBe("b");
    h = undone(undone(undone(h)));
    expect(h.present).toBe("a");
    h = redone(redone(redone(h)));
    expect(h.present).toBe("c");
  });

  it("keeps one step for one gesture", () => {
    let h = startHistory(0);
    for (const x of [1, 2, 3]) h = changed(h, x, "drag 1");
    h = gestureEnded(h);
    for (const x of [4, 5]) h = changed(h, x, "drag 1");
    expect(undone(h).present).toBe(3);
    expect(undone(undone(h)).present).toBe(0);
  });

  it("forgets the future on a new change and ignores no change", () => {
    const h = undone(changed(startHistory("a"), "b"));
    expect(redone(changed(h, "c")).present).toBe("c");
    expect(changed(h, "a")).toBe(h);
  });

  it("bounds its past", () => {
    let h = startHistory(0);
    for (let i = 1; i <= 500; i += 1) h = changed(h, i);
    expect(h.past.length).toBe(100);
  });
});
