import type { AppState } from "./app_state";
import { percentile, Ring, rate } from "./latencies";

const kLatencies = 200;
const kWindowMs = 1000;

/** Counts pictures and times them, for the readout and for benchmarks. */
export class Recorder {
  readonly #state: AppState;
  readonly #latencies = new Ring(kLatencies);
  readonly #drawn = new Ring(kLatencies);

  constructor(state: AppState) {
    this.#state = state;
    setInterval(() => this.#countFrames(), kWindowMs / 2);
  }

  /** A picture was drawn at `at`; `inputAt` where it is the first to show that input. */
  drawn(at: number, inputAt: number | undefined): void {
    this.#drawn.push(at);
    this.#countFrames();
    if (inputAt === undefined) return;
    this.#latencies.push(at - inputAt);
    const values = this.#latencies.values();
    const p50 = percentile(values, 0.5);
    const p95 = percentile(values, 0.95);
    if (p50 !== undefined && p95 !== undefined) this.#state.latency.value = { p50, p95 };
  }

  /** Input to drawn in ms, oldest first. */
  latencies(): readonly number[] {
    return this.#latencies.values();
  }

  clear(): void {
    this.#latencies.clear();
  }

  #countFrames(): void {
    this.#state.framesPerSecond.value = rate(this.#drawn.values(), performance.now(), kWindowMs);
  }
}
