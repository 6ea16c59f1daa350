import { useSignal } from "@preact/signals";
import { Role } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "../state/app_state";
import { myself } from "../state/people";
import { CopyField } from "./copy_field";
import { SelectLine } from "./inputs";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

const kHour = 3600;

const kRoles: readonly (readonly [Role, string])[] = [
  [Role.WATCH, "watch"],
  [Role.CONTROL, "steer, in turns"],
];

const kLives: readonly (readonly [number, string])[] = [
  [kHour, "an hour"],
  [24 * kHour, "a day"],
  [7 * 24 * kHour, "a week"],
  [30 * 24 * kHour, "30 days"],
];

/** Links that let others into this very view: they see what is done in it as it happens. */
export function ShareLinks({ state, port }: Props) {
  const role = useSignal(Role.WATCH);
  const life = useSignal(24 * kHour);
  const made = state.links.value.find((l) => l.role === role.value);
  if (myself(state)?.role === Role.WATCH) {
    return <p class="hint">Who watches cannot invite others; ask somebody who may steer.</p>;
  }
  const page = `${location.origin}${location.pathname}`;
  return (
    <section aria-labelledby="links-heading">
      <h3 id="links-heading">Invite by a link</h3>
      <SelectLine
        label="Whoever has it may"
        value={role.value}
        options={kRoles}
        take={(r) => {
          role.value = r;
        }}
      />
      <SelectLine
        label="It works for"
        value={life.value}
        options={kLives}
        take={(s) => {
          life.value = s;
        }}
      />
      <button
        type="button"
        class="text-button"
        disabled={!state.seat.value}
        onClick={() => port.share(role.value, life.value)}
      >
        {made ? "Make another link" : "Make a link"}
      </button>
      {made && (
        <>
          <CopyField
            label={made.role === Role.WATCH ? "Link to watch" : "Link to steer"}
            text={`${page}#link=${made.link}`}
          />
          <p class="hint">Until {new Date(1000 * made.expires).toLocaleString()}.</p>
        </>
      )}
    </section>
  );
}
