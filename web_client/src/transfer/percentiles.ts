/** The value that `percent` of the data is not above; straight between the whole per cents. */
export function percentileOf(percentiles: readonly number[], percent: number): number | undefined {
  const place = (percent / 100) * (percentiles.length - 1);
  const low = percentiles[Math.floor(place)];
  const high = percentiles[Math.ceil(place)];
  if (low === undefined || high === undefined) return undefined;
  return low + (place - Math.floor(place)) * (high - low);
}
