type Numbers = readonly number[];

const kMostHalvings = 10;

/**
 * Places between 0 and 1 at which a curve has to be met so that straight lines between them, `at`
 * its own numbers, are off by at most `error` in what is `shown` of them.
 */
export function bends(
  at: (t: number) => Numbers,
  shown: (numbers: Numbers) => Numbers,
  error: number,
): number[] {
  const within = (from: number, to: number, halvings: number): number[] => {
    const [first, last] = [at(from), at(to)];
    const isOff = [0.25, 0.5, 0.75].some((t) => {
      const line = shown(first.map((x, k) => x + t * ((last[k] ?? x) - x)));
      return shown(at(from + t * (to - from))).some((x, k) => Math.abs(x - (line[k] ?? x)) > error);
    });
    if (!isOff || halvings === 0) return [];
    const middle = (from + to) / 2;
    return [...within(from, middle, halvings - 1), middle, ...within(middle, to, halvings - 1)];
  };
  return within(0, 1, kMostHalvings);
}
