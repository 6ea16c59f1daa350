import { type AppState, notify, type Steps } from "../state/app_state";
import { newAsk, steers } from "../state/people";
import { type People, Role, type ViewOpened, type ViewShared } from "./gen/volcast/v1/session_pb";
import type { Wire } from "./wire";

/**
 * Who is in a view, and what one may do in it. Once others can be there, the server's history of the
 * view is the one that undo goes back over; it began with the view, so nothing of it is missing.
 */
export class ViewPeople {
  readonly #wire: Wire;
  readonly #state: AppState;
  readonly #view: () => number | undefined;
  #steps: Steps = { canUndo: false, canRedo: false };

  constructor(wire: Wire, state: AppState, view: () => number | undefined) {
    this.#wire = wire;
    this.#state = state;
    this.#view = view;
  }

  takeControl(): void {
    const view = this.#view();
    if (view !== undefined) this.#wire.send({ case: "takeControl", value: { view } });
  }

  handOver(person: number): void {
    const view = this.#view();
    if (view !== undefined) this.#wire.send({ case: "handOver", value: { view, person } });
  }

  /** Lets who steers know that one would like to, or no more. */
  askControl(withdraw: boolean): void {
    const view = this.#view();
    if (view !== undefined) this.#wire.send({ case: "askControl", value: { view, withdraw } });
  }

  /** Asks for a link; it arrives in `state.links`. `expiresS`: from now; 0: a day. */
  share(role: Role, expiresS: number): void {
    const view = this.#view();
    if (view !== undefined) this.#wire.send({ case: "shareView", value: { view, role, expiresS } });
  }

  /** A link that leads back into the view with the role that one has; undefined: there is none. */
  get wayBack(): string | undefined {
    const made = this.#state.links.value.find((l) => l.role === Role.CONTROL);
    return made?.link ?? this.#state.seat.value?.link;
  }

  opened({ id, role, canUndo, canRedo }: ViewOpened, link: string | undefined): void {
    this.#state.seat.value = { id, role, link };
    this.stepped({ canUndo, canRedo });
    if (link !== undefined) this.#share();
  }

  /** The view that was open is not there any more. */
  left(): void {
    this.#state.seat.value = undefined;
    this.#state.people.value = [];
    this.#state.links.value = [];
    this.#state.serverSteps.value = undefined;
  }

  listed({ people }: People): void {
    const before = this.#state.people.value;
    this.#state.people.value = people;
    if (people.length > 1) this.#share();
    const ask = steers(this.#state) ? newAsk(before, people) : undefined;
    if (ask) notify(this.#state, "info", ask);
  }

  shared({ role, link, expires }: ViewShared): void {
    const others = this.#state.links.value.filter((l) => l.role !== role);
    this.#state.links.value = [...others, { role, link, expires: Number(expires) }];
    this.#share();
  }

  /** What the server's history allows after the newest change of the view. */
  stepped(steps: Steps): void {
    this.#steps = steps;
    if (this.#state.serverSteps.value) this.#share();
  }

  #share(): void {
    this.#state.serverSteps.value = this.#steps;
  }
}
