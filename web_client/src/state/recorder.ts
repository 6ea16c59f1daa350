import type { AppState } from "./app_state";
import { percentile, Ring, rate } from "./latencies";

const kLatencies = 200;
const kWindowMs = 1000;

/** Milliseconds of one picture by stage, the server's and then the client's. */
export interface Stages {
  readonly wait: number;
  readonly upload: number;
  readonly draw: number;
  readonly readback: number;
  readonly encode: number;
  readonly queue: number;
  readonly decode: number;
}

/** Counts pictures and times them, for the readout and for benchmarks. */
export class Recorder {
  readonly #state: AppState;
  readonly #latencies = new Ring(kLatencies);
  readonly #stages = new Ring<Stages>(kLatencies);
  readonly #drawn = new Ring(kLatencies);

  readonly #timer: ReturnType<typeof setInterval>;

  constructor(state: AppState) {
    this.#state = state;
    this.#timer = setInterval(() => this.#countFrames(), kWindowMs / 2);
  }

  close(): void {
    clearInterval(this.#timer);
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

  /** A picture that was drawn for an input took this long by stage. */
  took(stages: Stages): void {
    this.#stages.push(stages);
  }

  /** Stages of the newest pictures, oldest first. */
  stages(): readonly Stages[] {
    return this.#stages.values();
  }

  /** Input to drawn in ms, oldest first. */
  latencies(): readonly number[] {
    return this.#latencies.values();
  }

  clear(): void {
    this.#latencies.clear();
    this.#stages.clear();
  }

  #countFrames(): void {
    this.#state.framesPerSecond.value = rate(this.#drawn.values(), performance.now(), kWindowMs);
  }
}
