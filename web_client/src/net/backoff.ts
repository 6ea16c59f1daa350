/** Waiting times between attempts to connect, in milliseconds. */
export interface BackoffSettings {
  readonly firstMs: number;
  readonly longestMs: number;
  /** Share of a wait that chance may take away, so that many clients do not return at once. */
  readonly spread: number;
}

export const kBackoff: BackoffSettings = { firstMs: 250, longestMs: 10_000, spread: 0.3 };

/** The wait before attempt `attempt` (0 is the first after a loss); `chance` in [0, 1). */
export function waitMs(attempt: number, chance: number, settings = kBackoff): number {
  const doubled = settings.firstMs * 2 ** Math.min(attempt, 30);
  return Math.min(doubled, settings.longestMs) * (1 - settings.spread * chance);
}
