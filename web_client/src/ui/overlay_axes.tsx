import type { AppState } from "../state/app_state";
import { alongAxis, frameOf, type Orbit } from "../view/camera";

interface Props {
  readonly state: AppState;
}

interface Arm {
  readonly axis: 0 | 1 | 2;
  readonly negative: boolean;
  /** CSS pixels from the middle, y down. */
  readonly x: number;
  readonly y: number;
  /** Towards the eye, from -1 to 1. */
  readonly depth: number;
}

const kNames = ["X", "Y", "Z"] as const;
const kLength = 32;
const kMiddle = 44;

/** The six half axes as they lie on the screen, farthest first. */
function armsOf(orbit: Orbit): Arm[] {
  const { toEye, up, right } = frameOf(orbit);
  const arms = ([0, 1, 2] as const).flatMap((axis) =>
    [false, true].map((negative) => {
      const sign = negative ? -kLength : kLength;
      const depth = (negative ? -1 : 1) * toEye[axis];
      return { axis, negative, x: sign * right[axis], y: -sign * up[axis], depth };
    }),
  );
  return arms.sort((a, b) => a.depth - b.depth);
}

function AxisButton({ state, arm }: Props & { readonly arm: Arm }) {
  const { axis, negative } = arm;
  const name = kNames[axis];
  return (
    <button
      type="button"
      class="axis-end"
      tabIndex={-1}
      data-axis={name}
      data-negative={negative ? "" : undefined}
      aria-label={`Look from ${negative ? "minus" : "plus"} ${name}`}
      title={`From ${negative ? "−" : "+"}${name} (${negative ? "Shift " : ""}${axis + 1})`}
      style={{
        left: `${kMiddle + arm.x}px`,
        top: `${kMiddle + arm.y}px`,
        opacity: String(0.7 + 0.3 * arm.depth),
      }}
      onClick={() => {
        if (state.orbit.value) state.orbit.value = alongAxis(state.orbit.value, axis, negative);
      }}
    >
      {negative ? "" : name}
    </button>
  );
}

/** The coordinate axes as the picture shows them; a click on an end looks from there. */
export function AxesOverlay({ state }: Props) {
  const orbit = state.shownOrbit.value;
  if (!orbit) return null;
  const arms = armsOf(orbit);
  return (
    <fieldset class="axes" aria-label="Orientation">
      <svg viewBox="-44 -44 88 88" aria-hidden="true">
        {arms
          .filter((arm) => !arm.negative)
          .map(({ axis, x, y }) => (
            <line key={axis} class="axis-arm" data-axis={kNames[axis]} x2={x} y2={y} />
          ))}
      </svg>
      {arms.map((arm) => (
        <AxisButton key={`${arm.axis}${arm.negative}`} state={state} arm={arm} />
      ))}
    </fieldset>
  );
}
