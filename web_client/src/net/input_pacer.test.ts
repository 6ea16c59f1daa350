import { describe, expect, it } from "vitest";
import { type Dirty, InputPacer } from "./input_pacer";

function setUp(open = true) {
  const sent: { dirty: Dirty; seq: bigint }[] = [];
  const frames: (() => void)[] = [];
  const link = { open };
  const clock = { ms: 0 };
  const pacer = new InputPacer(
    (dirty, seq) => {
      if (link.open) sent.push({ dirty: { ...dirty }, seq });
      return link.open;
    },
    (run) => frames.push(run),
    () => clock.ms,
  );
  const nextFrame = (): void => {
    clock.ms += 16;
    for (const run of frames.splice(0)) run();
  };
  return { pacer, sent, nextFrame, link, clock };
}

describe("input pacer", () => {
  it("sends the first input at once", () => {
    const { pacer, sent } = setUp();
    pacer.mark("camera", 5);
    expect(sent).toEqual([{ dirty: { camera: true, scene: false, viewport: false }, seq: 1n }]);
  });

  it("joins what happens while the server is busy into one update", () => {
    const { pacer, sent } = setUp();
    pacer.mark("camera", 5);
    pacer.mark("camera", 6);
    pacer.mark("scene", 7);
    expect(sent).toHaveLength(1);
    pacer.answered(1n);
    expect(sent).toHaveLength(2);
    expect(sent[1]).toEqual({ dirty: { camera: true, scene: true, viewport: false }, seq: 2n });
    pacer.answered(2n);
    expect(sent).toHaveLength(2);
    expect(pacer.settled).toBe(true);
  });

  it("sends a few updates for one slow answer, and never many", () => {
    const { pacer, sent, nextFrame, clock } = setUp();
    let answeredCount = 0;
    for (let answer = 0; answer < 20; answer += 1) {
      for (let frame = 0; frame < 30; frame += 1) {
        pacer.mark("camera", clock.ms);
        nextFrame();
      }
      const before = sent.length;
      pacer.answered(sent[sent.length - 1]?.seq ?? 0n);
      if (answer > 10) expect(before - answeredCount).toBeLessThanOrEqual(4);
      if (answer > 10) expect(before - answeredCount).toBeGreaterThanOrEqual(2);
      answeredCount = before;
    }
  });

  it("goes on after a second without any answer", () => {
    const { pacer, sent, nextFrame, clock } = setUp();
    for (let frame = 0; frame < 20; frame += 1) {
      pacer.mark("camera", clock.ms);
      nextFrame();
    }
    expect(sent).toHaveLength(4);
    for (let frame = 0; frame < 100; frame += 1) nextFrame();
    expect(sent).toHaveLength(5);
  });

  it("does not wait longer than the next animation frame", () => {
    const { pacer, sent, nextFrame } = setUp();
    pacer.mark("camera", 5);
    pacer.mark("camera", 6);
    nextFrame();
    expect(sent.map((s) => s.seq)).toEqual([1n, 2n]);
    nextFrame();
    expect(sent).toHaveLength(2);
  });

  it("measures from the oldest input that an update holds, once", () => {
    const { pacer } = setUp();
    pacer.mark("camera", 5);
    pacer.mark("camera", 6);
    pacer.mark("camera", 9);
    pacer.answered(1n);
    expect(pacer.takeInputTime(2n)).toBe(6);
    expect(pacer.takeInputTime(2n)).toBeUndefined();
    expect(pacer.takeInputTime(1n)).toBeUndefined();
  });

  it("keeps changes while there is no view, and hands them to the one that opens", () => {
    const { pacer, sent, link } = setUp(false);
    pacer.mark("camera", 5);
    expect(sent).toHaveLength(0);
    expect(pacer.settled).toBe(false);
    link.open = true;
    expect(pacer.takeForOpen()).toBe(1n);
    expect(pacer.settled).toBe(false);
    pacer.answered(1n);
    expect(pacer.settled).toBe(true);
    expect(pacer.takeInputTime(1n)).toBeUndefined();
  });
});
