import type { AppState, Edit } from "../state/app_state";
import { steers } from "../state/people";
import { cameraMessage, sceneMessage } from "../state/scene_message";
import type { Error as ErrorMessage } from "./gen/volcast/v1/error_pb";
import { type Dirty, InputPacer } from "./input_pacer";
import type { Wire } from "./wire";

/** The state of a view on its way to the server: what leaves when, what was taken and what refused. */
export class ViewUpdates {
  readonly pacer: InputPacer;
  readonly #wire: Wire;
  readonly #state: AppState;
  /** The view that is shown. */
  readonly #view: () => number | undefined;
  readonly #changed: () => void;
  /** The newest settings that were sent, and the Update they went with. */
  #sent: { readonly inputSeq: bigint; readonly edit: Edit } | undefined;

  /** `changed` hears of every Update that changes what the view shows. */
  constructor(
    wire: Wire,
    state: AppState,
    view: () => number | undefined,
    changed: () => void,
    newest: bigint,
  ) {
    this.#wire = wire;
    this.#state = state;
    this.#view = view;
    this.#changed = changed;
    this.pacer = new InputPacer(
      (dirty, inputSeq) => this.#send(dirty, inputSeq),
      (run) => requestAnimationFrame(run),
      () => performance.now(),
    );
    this.continueFrom(newest);
  }

  /** A part of the state changed; the newest state is sent when the server can use it. */
  mark(part: keyof Dirty): void {
    if (part !== "viewport" && !steers(this.#state)) return;
    this.pacer.mark(part, this.#inputAt());
  }

  /** A number for a step in the server's history. */
  takeStep(): bigint {
    const inputSeq = this.pacer.takeNext(this.#inputAt());
    this.#state.newestInput.value = inputSeq;
    return inputSeq;
  }

  takeForOpen(): bigint {
    const inputSeq = this.pacer.takeForOpen();
    this.#state.newestInput.value = inputSeq;
    return inputSeq;
  }

  /** Inputs go on from `inputSeq`. */
  continueFrom(inputSeq: bigint): void {
    this.pacer.continueFrom(inputSeq);
    this.#state.newestInput.value = this.pacer.newest;
  }

  /** What is shown is what the server has. */
  agreed(): void {
    this.#sent = undefined;
    this.#state.refusal.value = undefined;
    this.#state.accepted.value = this.#state.edit.value.present;
  }

  /** A picture of `inputSeq` is there: settings up to it were taken, if they were not refused. */
  answered(inputSeq: bigint): void {
    this.pacer.answered(inputSeq);
    const { refusal, accepted } = this.#state;
    const sent = this.#sent;
    if (!sent || inputSeq < sent.inputSeq || sent.inputSeq === refusal.value?.inputSeq) return;
    accepted.value = sent.edit;
    refusal.value = undefined;
  }

  /** True where the error says that the newest settings are not drawn; what was there before stays. */
  tookError({ field, inputSeq, message }: ErrorMessage): boolean {
    const refused = field !== "" && inputSeq === this.#sent?.inputSeq;
    if (refused) {
      this.#state.refusal.value = { inputSeq, field, message };
      this.mark("camera"); // Both may have been parts of the refused update.
    }
    return refused;
  }

  /** True where settings that were drawn for a while have failed by themselves. */
  failsLater(inputSeq: bigint): boolean {
    return this.#sent !== undefined && inputSeq > this.#sent.inputSeq;
  }

  #inputAt(): number {
    const { input } = this.#state;
    const at = input.at ?? performance.now();
    input.at = undefined;
    return at;
  }

  #send(dirty: Readonly<Dirty>, inputSeq: bigint): boolean {
    const { scene, orbit, bounds, viewport } = this.#state;
    const edit = this.#state.edit.value.present;
    const view = this.#view();
    if (view === undefined || !scene.value || !orbit.value) return false;
    const sent = this.#wire.send({
      case: "update",
      value: {
        view,
        inputSeq,
        scene: dirty.scene ? sceneMessage(scene.value, orbit.value, bounds.value, edit) : undefined,
        camera: dirty.camera && !dirty.scene ? cameraMessage(orbit.value, bounds.value) : undefined,
        viewport: dirty.viewport ? viewport.value : undefined,
      },
    });
    if (!sent) return false;
    this.#state.newestInput.value = inputSeq;
    if (dirty.scene) this.#sent = { inputSeq, edit };
    if (dirty.scene || dirty.camera) this.#changed();
    return true;
  }
}
