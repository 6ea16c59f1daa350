import { type AppState, type Maps, notify } from "../state/app_state";
import type { ViewDocument } from "../state/document";
import { isShared, steers, whyNotSteering } from "../state/people";
import { sentenceOf } from "../state/refusal";
import { sceneMessage } from "../state/scene_message";
import { removeCode } from "../state/shader_actions";
import type { Frame } from "./framing";
import type { Error as ErrorMessage } from "./gen/volcast/v1/error_pb";
import type { Camera, Scene } from "./gen/volcast/v1/scene_pb";
import {
  DatasetState,
  type People,
  type SceneChanged,
  type Thumbnail,
  type ViewOpened,
  ViewState,
  type ViewStatus,
} from "./gen/volcast/v1/session_pb";
import type { Dirty } from "./input_pacer";
import { ViewPeople } from "./view_people";
import { ViewQuestions } from "./view_questions";
import { ViewUpdates } from "./view_updates";
import type { Wire } from "./wire";
import { kAnything, type Wish, wishFor, wishToJoin, wishToStay } from "./wish";

/** What a view's conversation asks of whoever shows the view. */
export interface ViewEvents {
  /** A frame of the view that is shown, or of the one that is about to be. */
  frame(frame: Frame, receivedAt: number): void;
  /** Pictures that are still being decoded are of a connection that is gone. */
  restarted(): void;
  /** The server opened a view with its own default scene. */
  opened(scene: Scene): void;
  /** The view of a link is open, or one with a scene that was saved. */
  joined(scene: Scene, edit?: Maps): void;
  /** A view was opened with a document that was not shown before. */
  restored(document: ViewDocument): void;
  /** The scene is another, by somebody else or by a step in its history. */
  followed(scene: Scene): void;
  moved(camera: Camera): void;
  /** The thumbnail that was asked for last, or why there is none. */
  thumbnail(answer: Thumbnail): void;
  /** What is shown now with all its edits, to open it again after a loss. */
  current(): ViewDocument | undefined;
}

/** A view that a page before this one had open, or what it is to begin with. */
export interface ViewBeginning {
  /** Its number in the connection that the page goes on with. */
  readonly number?: number | undefined;
  readonly inputSeq?: bigint | undefined;
  readonly wish?: Wish | undefined;
}

interface Opening extends Wish {
  readonly view: number;
}

/**
 * What is said about one view, from its opening to its end. After a loss the view goes on where the
 * server kept it; else it is joined again by its link, or opened again as it was.
 */
export class ViewConversation {
  readonly people: ViewPeople;
  readonly questions: ViewQuestions;
  readonly #wire: Wire;
  readonly #state: AppState;
  readonly #events: ViewEvents;
  readonly #updates: ViewUpdates;
  /** The view that is shown. */
  #view: number | undefined;
  #opening: Opening | undefined;
  /** Asked for and not opened yet. */
  #wish: Wish | undefined;
  /** The server has not said yet whether it kept the view over the loss of the connection. */
  #returning = false;
  /** It did; who steers the view is not known yet. */
  #returned: ViewOpened | undefined;
  #peopleKnown = false;

  constructor(wire: Wire, state: AppState, events: ViewEvents, beginning: ViewBeginning = {}) {
    const view = (): number | undefined => this.#view;
    this.#wire = wire;
    this.#state = state;
    this.#events = events;
    this.#view = beginning.number;
    this.#wish = beginning.wish;
    this.people = new ViewPeople(wire, state, view);
    this.questions = new ViewQuestions(wire, state, view, (answer) => events.thumbnail(answer));
    const changed = (): void => this.people.stepped({ canUndo: true, canRedo: false });
    this.#updates = new ViewUpdates(wire, state, view, changed, beginning.inputSeq ?? 0n);
  }

  /** The view's number in the connection, where the server may know it. */
  get number(): number | undefined {
    return this.#view;
  }

  /** The newest input; one that the server cannot have where something was not sent. */
  get inputSeq(): bigint {
    const { holdsScene, newest } = this.#updates.pacer;
    return holdsScene ? newest + 1n : newest;
  }

  owns(view: number): boolean {
    return view === this.#view || view === this.#opening?.view;
  }

  /** Shows something else once it is there; what is shown now stays until then. */
  open(wish: Wish): void {
    const why = whyNotSteering(this.#state);
    if (why) notify(this.#state, "info", why);
    else this.#want(wish);
  }

  /** Joins the view of a link; what is shown now stays until then. */
  join(link: string): void {
    this.#want(wishToJoin(link));
  }

  /** Goes on where nobody else is: with a copy of the view, or with something else. */
  leave(document?: ViewDocument): void {
    const wish = document ? wishFor(document) : wishToStay(this.#events.current());
    this.#want({ ...wish, alone: true });
  }

  /** A part of the state changed; the newest state is sent when the server can use it. */
  mark(part: keyof Dirty): void {
    this.#updates.mark(part);
  }

  /** The picture's size is known or changed. */
  resized(): void {
    if (this.#wire.greeted && this.#view === undefined && !this.#opening) this.#open();
    else this.mark("viewport");
  }

  /** Sends everything again: the way out of a failed view. */
  drawAgain(): void {
    if (this.#view !== undefined) this.mark("scene");
    else if (this.#wire.greeted && !this.#opening) this.#open();
  }

  /** One step back in the server's history of the view, or forward again. */
  step(redo: boolean): void {
    const view = this.#view;
    if (view === undefined) return;
    const inputSeq = this.#updates.takeStep();
    this.#wire.send({ case: "undo", value: { view, redo, inputSeq } });
  }

  /** When the input that this frame is the first to show happened. */
  takeInputTime(inputSeq: bigint): number | undefined {
    return this.#updates.pacer.takeInputTime(inputSeq);
  }

  close(): void {
    for (const view of [this.#view, this.#opening?.view]) {
      if (view !== undefined) this.#close(view);
    }
    this.#view = undefined;
    this.#opening = undefined;
  }

  /** The connection is lost. */
  lost(): void {
    this.#opening = undefined;
    this.#returned = undefined;
    this.#state.view.value = undefined;
    this.questions.ended("the connection was lost");
  }

  /** A connection is there; `resumed`: the server says next which views it kept. */
  welcomed(resumed: boolean): void {
    this.#peopleKnown = false;
    this.#returning = resumed && this.#view !== undefined;
    if (!this.#returning) this.#openAgain();
    else if (this.#wish) this.#open();
  }

  frame(frame: Frame, receivedAt: number): void {
    this.#updates.answered(frame.header.inputSeq);
    this.#events.frame(frame, receivedAt);
  }

  opened(message: ViewOpened): void {
    if (message.view === this.#view) {
      this.#returned = message;
      if (this.#peopleKnown) this.#goOn(message);
    } else if (this.#opening) {
      this.#begin(this.#opening, message);
    }
  }

  listed(message: People): void {
    if (message.view !== this.#view) return;
    const steered = steers(this.#state);
    this.people.listed(message);
    this.#peopleKnown = true;
    if (!steers(this.#state)) this.#updates.pacer.forgetScene();
    else if (!steered) this.mark("viewport"); // Numbered as the view's inputs from now on.
    if (this.#returned) this.#goOn(this.#returned);
  }

  changed({ view, scene, camera, inputSeq, canUndo, canRedo }: SceneChanged): void {
    if (view !== this.#view) return;
    this.people.stepped({ canUndo, canRedo });
    if (scene) this.#follow(scene);
    else if (camera) this.#events.moved(camera);
    this.#updates.continueFrom(inputSeq);
  }

  status({ view, state, message }: ViewStatus): void {
    const opening = view === this.#opening?.view;
    if (opening && state === ViewState.FAILED) this.#giveUpOpening(message);
    else if (!opening || this.#view === undefined) this.#state.view.value = { state, message };
  }

  error(error: ErrorMessage): void {
    const { view, inputSeq, field, dataset } = error;
    if (view === this.#view && this.questions.tookError(error)) return;
    if (inputSeq > 0n) this.#updates.pacer.answered(inputSeq);
    if (view === this.#opening?.view) {
      this.#giveUpOpening(sentenceOf(error));
      return;
    }
    if (this.#returning && inputSeq === 0n) {
      this.#openAgain(); // The view has ended meanwhile.
      return;
    }
    if (!this.#updates.tookError(error) && !this.#isListed(dataset)) {
      notify(this.#state, "error", sentenceOf(error));
      // Code that drew well has failed by itself: the view is back at what was there before it.
      if (this.#updates.failsLater(inputSeq) && /\.shader\./.test(field)) removeCode(this.#state);
    }
    // No picture of the refused input comes; one of this does.
    if (inputSeq > 0n && inputSeq === this.#updates.pacer.newest) this.mark("viewport");
  }

  #want(wish: Wish): void {
    this.#wish = wish;
    if (this.#wire.greeted) this.#open();
  }

  #open(): void {
    const viewport = this.#state.viewport.value;
    if (!viewport) return;
    if (this.#opening) this.#close(this.#opening.view);
    const view = this.#wire.newNumber();
    const wish = this.#wish ?? wishToStay(this.#events.current());
    const { dataset, document, link, scene: saved } = wish;
    this.#opening = { ...wish, view };
    this.#state.pendingDataset.value = dataset || undefined;
    if (this.#view === undefined) {
      this.#state.view.value = { state: ViewState.WAITING, message: "" };
    }
    const box = dataset === this.#state.dataset.value?.id ? this.#state.bounds.value : undefined;
    const drawn = document && sceneMessage(document.scene, document.orbit, box, document.edit);
    const inputSeq = this.#updates.takeForOpen();
    const scene = saved ?? drawn;
    const value = { view, dataset, viewport, inputSeq, scene, ...(link && { link }) };
    this.#wire.send({ case: "openView", value });
  }

  /** The server does not have the view any more: joins it by its link, or opens it as it was. */
  #openAgain(): void {
    const link = this.people.wayBack;
    this.#view = undefined;
    this.#returning = false;
    this.people.left();
    if (link !== undefined) this.#wish ??= wishToJoin(link);
    this.#open();
  }

  #close(view: number): void {
    this.#wire.send({ case: "closeView", value: { view } });
  }

  #begin(opening: Opening, message: ViewOpened): void {
    const { scene, view, inputSeq } = message;
    const before = this.#view;
    // Others go along: the view that they are in shows what was opened.
    const apart = opening.alone || opening.shown || opening.link !== undefined;
    const along = !apart && isShared(this.#state) && before !== undefined;
    this.#opening = undefined;
    this.#wish = undefined;
    this.#state.pendingDataset.value = undefined;
    this.#state.view.value = { state: ViewState.ACTIVE, message: "" };
    this.questions.ended("other data is shown");
    if (along) {
      this.#close(view);
    } else {
      if (before !== undefined) this.#close(before);
      this.#view = view;
      this.#peopleKnown = false;
      this.people.left();
      this.people.opened(message, opening.link);
    }
    if ((opening.link || opening.scene) && scene) this.#events.joined(scene, opening.edit);
    else if (!opening.document && scene) this.#events.opened(scene);
    else if (opening.document && !opening.shown) this.#events.restored(opening.document);
    if (!opening.shown) this.#updates.agreed();
    if (along) this.mark("scene");
    this.#updates.continueFrom(inputSeq);
    // Of a view that counted less than this page did, the next pictures come with a number from here.
    if (this.#updates.pacer.newest > inputSeq) this.mark("viewport");
  }

  /** The server kept the view: what was done here since then is sent, if it is still one's own. */
  #goOn(message: ViewOpened): void {
    const { holdsScene, newest } = this.#updates.pacer;
    const known = !holdsScene && message.inputSeq === newest;
    const own = message.inputSeq <= newest && steers(this.#state);
    this.#returning = false;
    this.#returned = undefined;
    this.#events.restarted();
    this.#state.view.value = { state: ViewState.ACTIVE, message: "" };
    this.people.opened(message, this.#state.seat.value?.link);
    if (!own && message.scene) this.#follow(message.scene);
    this.#updates.continueFrom(message.inputSeq);
    if (own && !known) this.mark("scene");
    this.mark("viewport"); // The server has the size that was there before.
  }

  #follow(scene: Scene): void {
    this.#updates.pacer.forgetScene();
    this.#events.followed(scene);
    this.#updates.agreed();
  }

  /** The list shows this dataset's failure itself. */
  #isListed(dataset: string): boolean {
    const info = this.#state.datasets.value.find((d) => d.id === dataset);
    return info?.state === DatasetState.FAILED;
  }

  /** Keeps what is shown; a view that could not be restored is opened from scratch. */
  #giveUpOpening(reason: string): void {
    const opening = this.#opening;
    if (!opening) return;
    this.#close(opening.view);
    this.#opening = undefined;
    this.#wish = undefined;
    this.#state.pendingDataset.value = undefined;
    const copy = opening.link !== undefined && this.#events.current() !== undefined;
    notify(this.#state, "error", copy ? `${reason} What is shown is a copy of it.` : reason);
    if (this.#view !== undefined) {
      this.mark("camera"); // The view that is shown answers the newest input again.
    } else if (opening.document || opening.link || opening.scene) {
      this.#wish = copy ? undefined : kAnything;
      this.#open();
    } else {
      this.#state.view.value = { state: ViewState.FAILED, message: reason };
    }
  }
}
