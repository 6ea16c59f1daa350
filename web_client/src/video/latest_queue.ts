/** One item in work, one waiting: a newer one takes the waiting one's place. */
export class LatestQueue<T> {
  readonly #work: (item: T) => Promise<void>;
  readonly #dropped: (item: T) => void;
  #waiting: T | undefined;
  #busy = false;

  constructor(work: (item: T) => Promise<void>, dropped: (item: T) => void) {
    this.#work = work;
    this.#dropped = dropped;
  }

  get waiting(): number {
    return this.#waiting === undefined ? 0 : 1;
  }

  async push(item: T): Promise<void> {
    if (this.#busy) {
      const older = this.#waiting;
      this.#waiting = item;
      if (older !== undefined) this.#dropped(older);
      return;
    }
    this.#busy = true;
    let next: T | undefined = item;
    while (next !== undefined) {
      await this.#work(next);
      next = this.#waiting;
      this.#waiting = undefined;
    }
    this.#busy = false;
  }
}
