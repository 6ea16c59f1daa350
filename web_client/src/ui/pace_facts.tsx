import type { AppState } from "../state/app_state";
import { hasPins, type Pins, paceSentence } from "../state/pins";
import { formatBytes, formatMs } from "./format";
import { SelectLine } from "./inputs";

interface Props {
  readonly state: AppState;
}

/** In place of undefined, which no select can have. */
const kFree = "free";
type Free = typeof kFree;
type Choices<T> = readonly (readonly [value: T | Free, name: string])[];

const kAsAllowed = [kFree, "Automatic"] as const;
const kQualities: Choices<number> = [
  kAsAllowed,
  ...[100, 90, 75, 60, 45, 30].map((q) => [q, String(q)] as const),
];
const kScales: Choices<number> = [
  kAsAllowed,
  [1, "Full"],
  [0.75, "Three quarters"],
  [0.5, "Half"],
  [0.25, "A quarter"],
];
const kAccuracies: Choices<string> = [
  kAsAllowed,
  ["asked", "As accurate as asked"],
  ["fast", "As fast as possible"],
];
const kRates: Choices<number> = [
  kAsAllowed,
  ...[120, 60, 30, 15, 8, 4, 2, 1].map((r) => [r, String(r)] as const),
];

const free = <T,>(value: T | Free): T | undefined => (value === kFree ? undefined : (value as T));

function Choosers({ state }: Props) {
  const pins = state.pins.value;
  const pin = (part: Pins): void => {
    state.pins.value = { ...pins, ...part };
  };
  const { quality = kFree, scale = kFree, framesPerS = kFree, fullAccuracy } = pins;
  const accuracy = fullAccuracy === undefined ? kFree : fullAccuracy ? "asked" : "fast";
  return (
    <div class="options">
      <SelectLine
        label="Quality"
        value={quality}
        options={kQualities}
        take={(value) => pin({ quality: free<number>(value) })}
      />
      <SelectLine
        label="Size"
        value={scale}
        options={kScales}
        take={(value) => pin({ scale: free<number>(value) })}
      />
      <SelectLine
        label="Drawn"
        value={accuracy}
        options={kAccuracies}
        take={(value) => pin({ fullAccuracy: value === kFree ? undefined : value === "asked" })}
      />
      <SelectLine
        label="Pictures/s"
        value={framesPerS}
        options={kRates}
        take={(value) => pin({ framesPerS: free<number>(value) })}
      />
      {hasPins(pins) && (
        <button
          type="button"
          class="text-button"
          onClick={() => {
            state.pins.value = {};
          }}
        >
          All automatic
        </button>
      )}
    </div>
  );
}

/** What the server sends now and why, from the newest picture's header; and what is not to change. */
export function PaceFacts({ state }: Props) {
  const picture = state.picture.value;
  const pace = picture?.pace;
  const facts = pace && [
    ["Round trip", formatMs(pace.rttMs)],
    ["Queueing delay", formatMs(pace.queueDelayMs)],
    ["Under way", `${pace.underWay} of ${pace.window}`],
    ["Seen to take", pace.bytesPerS > 0 ? `${formatBytes(Math.round(pace.bytesPerS))}/s` : "–"],
  ];
  return (
    <div class="pace-facts">
      {picture && pace ? (
        <>
          <p class="pace-now">The newest picture: {paceSentence(picture, pace)}.</p>
          <p class="hint pace-reason">{pace.reason || "Nothing had to be given up."}</p>
          <dl class="plan-times">
            {facts?.map(([name, value]) => (
              <div key={name}>
                <dt>{name}</dt>
                <dd>{value}</dd>
              </div>
            ))}
          </dl>
        </>
      ) : (
        <p class="hint">The server has not said how it sends pictures.</p>
      )}
      <h3 class="plan-way">Of moving pictures, keep</h3>
      <Choosers state={state} />
    </div>
  );
}
