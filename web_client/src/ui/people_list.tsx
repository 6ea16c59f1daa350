import { type Person, Role } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "../state/app_state";
import { eachOnce, myself, noteOf, steers } from "../state/people";
import type { AppPort } from "./port";
import { ControlButton } from "./steer_note";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

/** The server's limit, in bytes of UTF-8. */
const kMostNameBytes = 64;

/** The start of a name that the server takes. */
function shortened(name: string): string {
  let text = name.trim();
  while (new TextEncoder().encode(text).length > kMostNameBytes) text = text.slice(0, -1);
  return text;
}

function Row({ state, port, person }: Props & { readonly person: Person }) {
  const others = person.id !== myself(state)?.id;
  return (
    <li class="person" data-steers={person.steers ? "" : undefined}>
      <span class="person-dot" aria-hidden="true" />
      <span class="person-name">{person.name}</span>
      <span class="hint">{noteOf(state, person)}</span>
      {others && steers(state) && !person.away && (
        <button
          type="button"
          class="text-button"
          aria-label={`Hand over to ${person.name}`}
          onClick={() => port.handOver(person.id)}
        >
          Hand over
        </button>
      )}
    </li>
  );
}

/** Who is in the view; one's own name, and what one can do about steering. */
export function PeopleList({ state, port }: Props) {
  const me = myself(state);
  const people = eachOnce(state.people.value);
  const joined = state.seat.value?.link !== undefined;
  return (
    <section aria-labelledby="people-heading">
      <h3 id="people-heading">In this view</h3>
      <label class="line name-line">
        <span>Your name</span>
        <input
          type="text"
          autocomplete="nickname"
          maxLength={kMostNameBytes}
          value={me?.name ?? ""}
          onChange={(e) => port.rename(shortened(e.currentTarget.value))}
        />
      </label>
      <ul class="people">
        {people.map((person) => (
          <Row key={person.id} state={state} port={port} person={person} />
        ))}
      </ul>
      <div class="person-actions">
        {!steers(state) && <ControlButton state={state} port={port} />}
        {!steers(state) && (
          <button type="button" class="text-button" onClick={port.addView}>
            Look around beside it
          </button>
        )}
        {joined && (
          <button type="button" class="text-button" onClick={port.leave}>
            Leave with a copy
          </button>
        )}
      </div>
      {!steers(state) && (
        <p class="hint">
          The picture follows whoever steers. A view of your own beside it does too, as long as
          cameras go together.
        </p>
      )}
      {me?.role === Role.CONTROL && people.length === 1 && (
        <p class="hint">Nobody else is here. A link below brings others in.</p>
      )}
    </section>
  );
}
