import { create, type MessageInitShape } from "@bufbuild/protobuf";
import {
  isMeasuring,
  type MeasureAim,
  measuringBegan,
  measuringEnded,
  measuringReported,
} from "../state/accuracy";
import type { AppState } from "../state/app_state";
import { comparingBegan, comparisonEnded, comparisonReported } from "../state/difference";
import { sentenceOf } from "../state/refusal";
import { type CodeOfData, takeDescription } from "../state/shader_actions";
import type { Error as ErrorMessage } from "./gen/volcast/v1/error_pb";
import type { Scene } from "./gen/volcast/v1/scene_pb";
import {
  type AccuracyReport,
  type DifferenceReport,
  type Picked,
  type PinsSchema,
  type Plan,
  type ShaderDescription,
  type Thumbnail,
  ThumbnailSchema,
} from "./gen/volcast/v1/session_pb";
import type { Wire } from "./wire";

/** Of a comparison: every pixel of a megapixel, if a minute is enough. */
const kCompared = { maxPixels: 2 ** 20, maxMs: 60_000 };

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

  /** Takes the thumbnail that was asked for last, or why there is none. */
  readonly thumbnail: (answer: Thumbnail) => void;

  constructor(
    wire: Wire,
    state: AppState,
    view: () => number | undefined,
    thumbnail: (answer: Thumbnail) => void,
  ) {
    this.#wire = wire;
    this.#state = state;
    this.#view = view;
    this.thumbnail = thumbnail;
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

  /** Measures ways to draw the view, what plans know of them, or effects; reports arrive in `state[aim]`. */
  measure(aim: MeasureAim): void {
    const view = this.#view();
    if (view === undefined) return;
    measuringBegan(this.#state, aim);
    const [estimate, effects] = [aim === "estimated", aim === "effectTimes"];
    this.#wire.send({ case: "measureAccuracy", value: { view, estimate, effects } });
  }

  /** Compares the picture with the reference; parts arrive in `state.difference`. */
  compare(): void {
    const view = this.#view();
    if (view === undefined) return;
    comparingBegan(this.#state);
    this.#wire.send({ case: "measureDifference", value: { view, ...kCompared } });
  }

  stopComparing(): void {
    const view = this.#view();
    if (view === undefined || !this.#state.difference.value?.running) return;
    this.#wire.send({ case: "measureDifference", value: { view, stop: true } });
  }

  /** Asks for a small picture of a scene; false where there is no view to ask in. */
  drawThumbnail(request: number, scene: Scene, width: number, height: number): boolean {
    const view = this.#view();
    if (view === undefined) return false;
    return this.#wire.send({
      case: "drawThumbnail",
      value: { view, request, scene, width, height },
    });
  }

  stopMeasuring(): void {
    const view = this.#view();
    if (view === undefined || !isMeasuring(this.#state)) return;
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

  compared(report: DifferenceReport): void {
    comparisonReported(this.#state, report);
  }

  /** Nothing more will be heard of what was measured or compared. */
  ended(why: string): void {
    measuringEnded(this.#state, why);
    comparisonEnded(this.#state, why);
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
    if (error.field.startsWith("draw_thumbnail")) {
      this.thumbnail(create(ThumbnailSchema, { refusal: error.message }));
      return true;
    }
    const running = isMeasuring(this.#state) || this.#state.difference.value?.running === true;
    const aboutIt = error.field === "view" || /^scene\.layers\[\d+\]\.shader$/.test(error.field);
    const refused = running && aboutIt && error.inputSeq === 0n;
    if (refused) this.ended(sentenceOf({ field: "", message: error.message }));
    return refused;
  }
}
