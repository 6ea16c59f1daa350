/** A number for people: four significant digits, powers of ten where they are shorter. */
export function formatNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa = "", exponent = ""] = value.toExponential(digits - 1).split("e");
    return `${mantissa.includes(".") ? mantissa.replace(/\.?0+$/, "") : mantissa}e${Number(exponent)}`;
  }
  return String(Number(value.toPrecision(digits)));
}

/** A value within a range of length `span`: what is nothing beside the range is 0. */
export function formatValue(value: number, span: number, digits = 4): string {
  return formatNumber(Math.abs(value) < 1e-6 * span ? 0 : value, digits);
}

/** A count: 1234 is 1,234 and 1234567 is 1.23 M. */
export function formatCount(count: number): string {
  if (count < 100_000) return count.toLocaleString("en");
  if (count < 1e6) return `${Math.round(count / 1000)} k`;
  return count < 1e9 ? `${(count / 1e6).toPrecision(3)} M` : `${(count / 1e9).toPrecision(3)} G`;
}

export function formatBytes(bytes: number): string {
  if (bytes < 1024) return `${bytes} B`;
  const units = ["KB", "MB", "GB", "TB"];
  let size = bytes / 1024;
  let unit = 0;
  while (size >= 1000 && unit < units.length - 1) {
    size /= 1024;
    unit += 1;
  }
  return `${size < 10 ? size.toFixed(1) : Math.round(size)} ${units[unit]}`;
}

export function formatMs(ms: number): string {
  return ms < 10 ? `${ms.toFixed(1)} ms` : `${Math.round(ms)} ms`;
}

/** Reads what a person typed, "12,5" and "30 %" included; undefined for no number. */
export function parseNumber(text: string): number | undefined {
  const plain = text.trim().replace(/\s*%$/, "").replace(",", ".").replace("−", "-");
  if (plain === "") return undefined;
  const value = Number(plain);
  return Number.isFinite(value) ? value : undefined;
}

/** Reads numbers with spaces, commas or semicolons between them; undefined where one is none. */
export function parseNumbers(text: string): number[] | undefined {
  const words = text.split(/[\s,;]+/).filter((word) => word !== "");
  const values = words.map(parseNumber);
  return values.some((v) => v === undefined) ? undefined : values.filter((v) => v !== undefined);
}
