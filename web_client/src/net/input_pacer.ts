/** What changed since the last Update. */
export interface Dirty {
  camera: boolean;
  scene: boolean;
  viewport: boolean;
}

/** Sends one Update; false where there is no open view to send it to. */
export type SendUpdate = (dirty: Readonly<Dirty>, inputSeq: bigint) => boolean;

/**
 * Decides when the newest state leaves: at once while the server owes nothing, else when it
 * answers or with the next animation frame. Whatever changes in between is sent once, newest
 * wins. Also remembers when each Update's oldest input happened, to measure input to drawn.
 */
export class InputPacer {
  readonly #send: SendUpdate;
  readonly #later: (run: () => void) => void;
  #dirty: Dirty = { camera: false, scene: false, viewport: false };
  #inputAt: number | undefined;
  #waiting = false;
  #newest = 0n;
  #answered = 0n;
  readonly #inputTimes = new Map<bigint, number>();

  /** `later` runs a function with the next animation frame. */
  constructor(send: SendUpdate, later: (run: () => void) => void) {
    this.#send = send;
    this.#later = later;
  }

  /** The newest number that was given out. */
  get newest(): bigint {
    return this.#newest;
  }

  /** Nothing waits to be sent and the newest Update has been answered. */
  get settled(): boolean {
    return !this.#isDirty() && this.#answered >= this.#newest;
  }

  /** Notes a change that happened at `inputAt` on performance.now()'s clock. */
  mark(part: keyof Dirty, inputAt: number): void {
    this.#dirty[part] = true;
    this.#inputAt ??= inputAt;
    if (this.#answered >= this.#newest) this.#flush();
    else this.#schedule();
  }

  /** A number for a view that is opened with everything: earlier changes are part of it. */
  takeForOpen(): bigint {
    this.#newest += 1n;
    this.#inputTimes.clear(); // Opening takes as long as an import: no measure of a response.
    this.#clear();
    return this.#newest;
  }

  /** A frame of `inputSeq` arrived: the server is free for the next state. */
  answered(inputSeq: bigint): void {
    if (inputSeq > this.#answered) this.#answered = inputSeq;
    if (this.#isDirty()) this.#flush();
  }

  /** When the input that this drawn frame is the first to show happened, else undefined. */
  takeInputTime(inputSeq: bigint): number | undefined {
    const at = this.#inputTimes.get(inputSeq);
    for (const seq of this.#inputTimes.keys()) {
      if (seq <= inputSeq) this.#inputTimes.delete(seq);
    }
    return at;
  }

  #isDirty(): boolean {
    return this.#dirty.camera || this.#dirty.scene || this.#dirty.viewport;
  }

  #clear(): void {
    this.#dirty = { camera: false, scene: false, viewport: false };
    this.#inputAt = undefined;
  }

  #schedule(): void {
    if (this.#waiting) return;
    this.#waiting = true;
    this.#later(() => {
      this.#waiting = false;
      this.#flush();
    });
  }

  #flush(): void {
    if (!this.#isDirty()) return;
    const seq = this.#newest + 1n;
    if (!this.#send(this.#dirty, seq)) return;
    this.#newest = seq;
    if (this.#inputAt !== undefined) this.#inputTimes.set(seq, this.#inputAt);
    this.#clear();
  }
}
