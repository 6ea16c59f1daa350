/** The newest `capacity` values, oldest first. */
export class Ring<T = number> {
  readonly #capacity: number;
  #values: T[] = [];

  constructor(capacity: number) {
    this.#capacity = capacity;
  }

  push(value: T): void {
    this.#values.push(value);
    if (this.#values.length > this.#capacity) this.#values.shift();
  }

  values(): readonly T[] {
    return [...this.#values];
  }

  clear(): void {
    this.#values = [];
  }
}

/** The value below which the share `p` of `values` lies (nearest rank); undefined for none. */
export function percentile(values: readonly number[], p: number): number | undefined {
  const sorted = [...values].sort((a, b) => a - b);
  const rank = Math.ceil(p * sorted.length);
  return sorted[Math.min(sorted.length, Math.max(1, rank)) - 1];
}

/** Events per second over the last `windowMs`, from their times in ms. */
export function rate(times: readonly number[], now: number, windowMs: number): number {
  const recent = times.filter((t) => now - t <= windowMs);
  return (recent.length * 1000) / windowMs;
}
