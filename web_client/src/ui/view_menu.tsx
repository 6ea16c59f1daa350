import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import type { AppState } from "../state/app_state";
import { whyNotSteering } from "../state/people";
import type { ViewOption } from "../state/view_options";
import { alongAxis } from "../view/camera";
import { Icon } from "./icons";
import { Check } from "./inputs";
import type { AppPort } from "./port";
import { RecordForm } from "./record_form";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

const kShown: readonly (readonly [ViewOption, string])[] = [
  ["axes", "Orientation axes"],
  ["scaleBar", "Scale bar"],
  ["legend", "Legend (L)"],
  ["box", "Bounding box (B)"],
  ["handles", "Handles of clip planes"],
  ["hud", "Performance (H)"],
];

const kSides = [0, 1, 2].flatMap((axis) =>
  [false, true].map((negative) => ({ axis: axis as 0 | 1 | 2, negative })),
);

function Sides({ state }: Pick<Props, "state">) {
  return (
    <fieldset class="view-sides" disabled={whyNotSteering(state) !== undefined}>
      <legend>Look from</legend>
      {kSides.map(({ axis, negative }) => (
        <button
          key={`${axis}${negative}`}
          type="button"
          class="text-button"
          aria-label={`${negative ? "Minus" : "Plus"} ${"XYZ"[axis]}`}
          onClick={() => {
            if (state.orbit.value) state.orbit.value = alongAxis(state.orbit.value, axis, negative);
          }}
        >
          {negative ? "−" : "+"}
          {"XYZ"[axis]}
        </button>
      ))}
    </fieldset>
  );
}

/** How one turns, and what is shown over the picture. */
export function ViewMenu({ state, port }: Props) {
  const open = useSignal(false);
  const menu = useRef<HTMLDivElement>(null);
  const options = state.options.value;
  return (
    <>
      <button
        type="button"
        class="icon-button"
        popovertarget="view-menu"
        aria-label="View"
        title="View: what is shown, how it turns"
      >
        <Icon name="view" />
      </button>
      <div
        ref={menu}
        id="view-menu"
        class="view-menu"
        popover="auto"
        role="dialog"
        aria-label="View"
        onToggle={(e) => {
          open.value = (e as ToggleEvent).newState === "open";
        }}
      >
        {open.value && (
          <>
            <fieldset>
              <legend>Show</legend>
              {kShown.map(([name, label]) => (
                <Check key={name} checked={options[name]} take={() => port.toggle(name)}>
                  {label}
                </Check>
              ))}
            </fieldset>
            <fieldset>
              <legend>Turn</legend>
              <Check checked={options.trackball} take={() => port.toggle("trackball")}>
                As a trackball (T)
              </Check>
            </fieldset>
            <Sides state={state} />
            {whyNotSteering(state) === undefined && (
              <RecordForm state={state} port={port} begun={() => menu.current?.hidePopover()} />
            )}
          </>
        )}
      </div>
    </>
  );
}
