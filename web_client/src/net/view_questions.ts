import type { MessageInitShape } from "@bufbuild/protobuf";
import { measuringBegan, measuringEnded, measuringReported } from "../state/accuracy";
import type { AppState } from "../state/app_state";
import { sentenceOf } from "../state/refusal";
import { type CodeOfData, takeDescription } from "../state/shader_actions";
import type { Error as ErrorMessage } from "./gen/volcast/v1/error_pb";
import type {
  AccuracyReport,
  Picked,
  PinsSchema,
  Plan,
  ShaderDescription,
} from "./gen/volcast/v1/session_pb";
import type { Wire } from "./wire";

/** What one asks about a view, whoever steers it; answers arrive in its state. */
export class ViewQuestions {
  readonly #wire: Wire;
  readonly #state: AppState;
  /** The view that is shown. */
  readonly #view: () => number | undefined;
  /** The pixel whose answer is waited for or shown. */
  #picking: { readonly inputSeq: bigint; readonly x: number; readonly y: number } | undefined;
  /** The code whose description is waited for. */
  #describing: { readonly request: number; readonly asked: CodeOfData } | undefined;

  constructor(wire: Wire, state: AppState, view: () => number | undefined) {
    this.#wire = wire;
    this.#state = state;
    this.#view = view;
  }

  /** Asks what a pixel of the picture of `inputSeq` shows; the answer is in `state.picked`. */
  pick(inputSeq: bigint, x: number, y: number): void {
    const view = this.#view();
    if (view === undefined) return;
    this.#picking = { inputSeq, x, y };
    this.#wire.send({ case: "pick", value: { view, inputSeq, x, y } });
  }

  /** The answer that may still come is of no use. */
  stopPicking(): void {
    this.#picking = undefined;
    this.#state.picked.value = undefined;
  }

  /** Asks how the newest picture was drawn; the answer is in `state.plan`. */
  explain(): void {
    const view = this.#view();
    if (view !== undefined) this.#wire.send({ case: "explain", value: { view } });
  }

  /** Measures the view's accuracy and cost; reports arrive in `state.measured`. */
  measureAccuracy(): void {
    const view = this.#view();
    if (view === undefined) return;
    measuringBegan(this.#state);
    this.#wire.send({ case: "measureAccuracy", value: { view } });
  }

  stopMeasuring(): void {
    const view = this.#view();
    if (view === undefined || !this.#state.measured.value?.running) return;
    this.#wire.send({ case: "measureAccuracy", value: { view, stop: true } });
  }

  /** Asks what the server reads in code; the newest answer alone counts. */
  describeShader(asked: CodeOfData): void {
    const request = this.#wire.newNumber();
    this.#describing = { request, asked };
    this.#wire.send({ case: "describeShader", value: { request, ...asked } });
  }

  /** Replaces what pacing must not change; undefined members are left to it. */
  setPins(pins: MessageInitShape<typeof PinsSchema>): void {
    const view = this.#view();
    if (view !== undefined) this.#wire.send({ case: "setPins", value: { view, pins } });
  }

  picked(picked: Picked): void {
    const asked = this.#picking;
    if (picked.x === asked?.x && picked.y === asked.y) this.#state.picked.value = picked;
  }

  planned(plan: Plan): void {
    this.#state.plan.value = plan;
  }

  measured(report: AccuracyReport): void {
    measuringReported(this.#state, report);
  }

  described({ request, controls, complaints }: ShaderDescription): void {
    const described = this.#describing;
    if (request !== described?.request) return;
    takeDescription(this.#state, { ...described.asked, controls, complaints });
  }

  /** True for an error that belongs to a question and needs nobody else. */
  tookError(error: ErrorMessage): boolean {
    // A pixel of a picture that newer ones have pushed out: the next picture is asked again.
    if (error.field === "input_seq" && error.inputSeq === this.#picking?.inputSeq) return true;
    const refused = error.field === "view" && this.#state.measured.value?.running === true;
    if (refused) {
      measuringEnded(this.#state, sentenceOf({ field: "", message: error.message }));
    }
    return refused;
  }
}
