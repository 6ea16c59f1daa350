/** What changed since the last Update. */
export interface Dirty {
  camera: boolean;
  scene: boolean;
  viewport: boolean;
}

/** Sends one Update; false where there is no open view to send it to. */
export type SendUpdate = (dirty: Readonly<Dirty>, inputSeq: bigint) => boolean;

/** Updates that may leave for one answer: more cannot be drawn, only sent, read and replaced. */
const kUpdatesAFrame = 3;
/** Updates without an answer, after which only an answer, or this much silence, brings the next. */
const kMostUnanswered = 4;
const kSilenceMs = 1000;

/**
 * Decides when the newest state leaves: at once while the server owes nothing; else when it
 * answers, and in between with animation frames, a few times in the time an answer takes, so that
 * what the server draws next is never old. Whatever changes in between is sent once, newest wins.
 * Also remembers when each Update's oldest input happened, to measure input to drawn.
 */
export class InputPacer {
  readonly #send: SendUpdate;
  readonly #later: (run: () => void) => void;
  readonly #now: () => number;
  #dirty: Dirty = { camera: false, scene: false, viewport: false };
  #inputAt: number | undefined;
  #waiting = false;
  #newest = 0n;
  #answered = 0n;
  /** When Updates without an answer were sent, oldest first. */
  readonly #unanswered = new Map<bigint, number>();
  #answerMs = 0;
  #sentAt = Number.NEGATIVE_INFINITY;
  readonly #inputTimes = new Map<bigint, number>();

  /** `later` runs a function with the next animation frame; `now` is a clock in ms. */
  constructor(send: SendUpdate, later: (run: () => void) => void, now: () => number) {
    this.#send = send;
    this.#later = later;
    this.#now = now;
  }

  /** The newest number that was given out. */
  get newest(): bigint {
    return this.#newest;
  }

  /** Nothing waits to be sent and the newest Update has been answered. */
  get settled(): boolean {
    return !this.#isDirty() && this.#answered >= this.#newest;
  }

  /** Something of the scene changed and was not sent. */
  get holdsScene(): boolean {
    return this.#dirty.camera || this.#dirty.scene;
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
    this.#unanswered.clear();
    this.#clear();
    return this.#newest;
  }

  /** A number for something that is no Update, behind all that changed before it. */
  takeNext(inputAt: number): bigint {
    this.#flush();
    return this.#number(inputAt);
  }

  /** The view's inputs go on from `inputSeq`: somebody else gave them, or a page before this one. */
  continueFrom(inputSeq: bigint): void {
    if (inputSeq > this.#newest) this.#newest = inputSeq;
    this.answered(this.#newest);
  }

  /** Changes that were not sent are of no use: somebody else decides what is seen. */
  forgetScene(): void {
    this.#dirty.camera = false;
    this.#dirty.scene = false;
  }

  /** A frame of `inputSeq` arrived: the server is free for the next state. */
  answered(inputSeq: bigint): void {
    if (inputSeq > this.#answered) this.#answered = inputSeq;
    for (const [seq, sentAt] of this.#unanswered) {
      if (seq > inputSeq) break;
      this.#answerMs += (this.#now() - sentAt - this.#answerMs) / 4;
      this.#unanswered.delete(seq);
    }
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
      if (this.#isTime()) this.#flush();
      else if (this.#isDirty()) this.#schedule();
    });
  }

  #isTime(): boolean {
    const since = this.#now() - this.#sentAt;
    if (this.#unanswered.size >= kMostUnanswered) return since > kSilenceMs;
    return since >= this.#answerMs / kUpdatesAFrame;
  }

  #flush(): void {
    if (!this.#isDirty()) return;
    const seq = this.#newest + 1n;
    if (!this.#send(this.#dirty, seq)) return;
    this.#number(this.#inputAt);
    this.#clear();
  }

  #number(inputAt: number | undefined): bigint {
    this.#newest += 1n;
    this.#sentAt = this.#now();
    this.#unanswered.set(this.#newest, this.#sentAt);
    if (inputAt !== undefined) this.#inputTimes.set(this.#newest, inputAt);
    return this.#newest;
  }
}
