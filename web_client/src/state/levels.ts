import { create } from "@bufbuild/protobuf";
import { type Levels, Levels_Spacing, LevelsSchema } from "../net/gen/volcast/v1/scene_pb";

/** As the panel offers them: a single level is a list of one. */
export type LevelsKind = "one" | "list" | "linear" | "log" | "power";

interface Range {
  readonly min: number;
  readonly max: number;
}

const kSpacings: Readonly<Record<LevelsKind, Levels_Spacing>> = {
  one: Levels_Spacing.LIST,
  list: Levels_Spacing.LIST,
  linear: Levels_Spacing.LINEAR,
  log: Levels_Spacing.LOG,
  power: Levels_Spacing.POWER,
};

const kDefaultCount = 5;
const kDefaultExponent = 2;

export function kindOf(levels: Levels): LevelsKind {
  if (levels.spacing === Levels_Spacing.LOG) return "log";
  if (levels.spacing === Levels_Spacing.LINEAR) return "linear";
  if (levels.spacing === Levels_Spacing.POWER) return "power";
  return levels.values.length === 1 ? "one" : "list";
}

export function isEmpty(levels: Levels | undefined): boolean {
  if (!levels) return true;
  const { spacing, values, count } = levels;
  return spacing === Levels_Spacing.LIST ? values.length === 0 : count < 1;
}

/** One level in the middle of a field's range, where there is the most to see. */
export function middleLevel({ min, max }: Range): Levels {
  return create(LevelsSchema, { values: [min + (max - min) / 2] });
}

/** The values that `levels` stands for, as the protocol defines them; none where it has no meaning. */
export function valuesOf(levels: Levels): number[] {
  const { spacing, values, first, last, count, exponent } = levels;
  if (spacing === Levels_Spacing.LIST) return [...values];
  if (spacing === Levels_Spacing.LOG && !(first > 0 && last > 0)) return [];
  const steps = Math.max(0, Math.min(256, Math.round(count)));
  return Array.from({ length: steps }, (_, i) => {
    const t = steps > 1 ? i / (steps - 1) : 0;
    if (spacing === Levels_Spacing.LOG) return first * (last / first) ** t;
    return first + (last - first) * t ** (spacing === Levels_Spacing.POWER ? exponent || 2 : 1);
  }).filter(Number.isFinite);
}

/** Ends for a run of levels that has none yet: the middle half of the range, above 0 for logs. */
function endsFor(kind: LevelsKind, levels: Levels, { min, max }: Range): Range {
  const { first, last } = levels;
  const usable = levels.spacing !== Levels_Spacing.LIST && first !== last;
  if (usable && (kind !== "log" || (first > 0 && last > 0))) return { min: first, max: last };
  const span = max - min;
  if (kind !== "log" || min > 0) return { min: min + span / 4, max: max - span / 4 };
  return { min: max / 100, max: max - span / 4 > 0 ? max - span / 4 : max };
}

/** The same levels told another way, as far as that goes. */
export function withKind(levels: Levels, kind: LevelsKind, range: Range): Levels {
  const values = valuesOf(levels);
  if (kind === "one") {
    const value = values[Math.floor(values.length / 2)];
    return value === undefined ? middleLevel(range) : create(LevelsSchema, { values: [value] });
  }
  if (kind === "list") {
    const [only] = values;
    if (values.length > 1 || only === undefined) return create(LevelsSchema, { values });
    const farther = range.max - only > only - range.min ? range.max : range.min;
    const both = [only, only + (farther - only) / 2];
    return create(LevelsSchema, { values: both.sort((a, b) => a - b) });
  }
  const ends = endsFor(kind, levels, range);
  return create(LevelsSchema, {
    spacing: kSpacings[kind],
    first: ends.min,
    last: ends.max,
    count: levels.count > 0 ? levels.count : kDefaultCount,
    exponent: kind === "power" ? levels.exponent || kDefaultExponent : 0,
  });
}

/** The same places in another field's range. */
export function movedTo(levels: Levels, from: Range, to: Range): Levels {
  const span = from.max - from.min;
  const move = (v: number): number =>
    to.min + (span > 0 ? (v - from.min) / span : 0.5) * (to.max - to.min);
  return create(LevelsSchema, {
    ...levels,
    values: levels.values.map(move),
    first: move(levels.first),
    last: move(levels.last),
  });
}
