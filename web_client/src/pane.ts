import { batch, computed, effect, type ReadonlySignal, untracked } from "@preact/signals";
import { Role } from "./net/gen/volcast/v1/session_pb";
import type { Session } from "./net/session";
import { type ViewBeginning, ViewConversation } from "./net/view_conversation";
import { kAnything, wishForScene } from "./net/wish";
import { Pictures } from "./pictures";
import { followProbe } from "./probe";
import { recordTurn } from "./record_turn";
import { savePicture } from "./save_picture";
import { loadedScene, saveScene } from "./scene_file";
import {
  adoptScene,
  currentDocument,
  redo,
  refitCamera,
  resetCamera,
  restoreDocument,
  undo,
} from "./state/actions";
import {
  type AppState,
  createAppState,
  notify,
  type SharedState,
  type ShareLink,
} from "./state/app_state";
import { needsComparison } from "./state/difference";
import type { ViewDocument } from "./state/document";
import { followCamera, followScene, joinScene } from "./state/follow";
import { followIdle } from "./state/idle_measure";
import { atRest, followThumbnails, ThumbnailKeeper, thumbnailSize } from "./state/model_thumbnails";
import { whyNotSteering } from "./state/people";
import { followPins } from "./state/pins";
import { codeToDescribe } from "./state/shader_actions";
import { followShownOrbit } from "./state/shown_orbit";
import { followTime } from "./state/time_steps";
import type { ViewPort } from "./ui/port";
import { withOtherProjection } from "./view/camera";
import { controlCamera } from "./view/camera_control";
import { createPictureElement, type PictureElement } from "./view/picture_element";
import type { Turn } from "./view/turning";
import { followSize, limited } from "./view/viewport";

const kMaxSide = 8192;

/** One view on the page: its state, its canvas with a worker of its own, and its conversation. */
export interface Pane {
  /** Of all panes that the page has had. */
  readonly key: number;
  readonly state: AppState;
  readonly picture: PictureElement;
  readonly pictures: Pictures;
  readonly conversation: ViewConversation;
  readonly port: ViewPort;
  /** Keeps the values of a place in sight, or lets it go. */
  togglePin(): void;
  /** Does `change` without telling the server. */
  adopt(change: () => void): void;
  close(): void;
}

export interface PaneBeginning extends ViewBeginning {
  /** What is shown before the server says anything. */
  readonly document?: ViewDocument | undefined;
  /** The link that the view was joined by, and those to it that were made. */
  readonly link?: string | undefined;
  readonly links?: readonly ShareLink[] | undefined;
}

/** What a page gives a pane, and hears of it. */
export interface PanePort {
  readonly session: Session;
  readonly shared: SharedState;
  /** What a drag does now; `around`: asked for by the Alt key. */
  turn(around: boolean): Turn;
  /** The camera moved, by hands here or by the one who steers the view. */
  moved(): void;
  /** Data is shown that was not there, by the camera that the server chose. */
  opened(): void;
}

let lastKey = 0;

export function openPane(page: PanePort, beginning: PaneBeginning): Pane {
  const { session } = page;
  const state = createAppState(page.shared);
  const picture = createPictureElement();
  const shownOrbit = followShownOrbit(state);
  const ends: (() => void)[] = [() => shownOrbit.end()];
  /** Views of datasets that were left, to come back to. */
  const left = new Map<string, ViewDocument>();
  /** True while signals take over what the server has already. */
  let adopting = false;
  const adopt = (change: () => void): void => {
    const before = adopting;
    adopting = true;
    batch(change);
    adopting = before;
  };
  const { document, link, links = [] } = beginning;
  if (document) restoreDocument(state, document);
  if (link !== undefined) state.seat.value = { id: "", role: Role.UNSPECIFIED, link };
  state.links.value = links;

  const conversation: ViewConversation = new ViewConversation(
    session,
    state,
    {
      frame: (frame, receivedAt) => pictures.show(frame, receivedAt),
      restarted: () => pictures.restart(),
      opened(scene) {
        thumbnails.lost();
        adopt(() => adoptScene(state, scene));
        shownOrbit.opened();
        page.opened();
        if (state.orbit.value !== state.home.value) conversation.mark("camera");
      },
      joined(scene, edit) {
        thumbnails.lost();
        adopt(() => joinScene(state, scene, edit));
        shownOrbit.opened();
      },
      restored(document) {
        thumbnails.lost();
        adopt(() => restoreDocument(state, document));
        shownOrbit.opened();
      },
      followed(scene) {
        adopt(() => followScene(state, scene));
        page.moved();
      },
      moved(camera) {
        adopt(() => followCamera(state, camera));
        page.moved();
      },
      thumbnail(answer) {
        if (thumbnails.answered(answer) && atRest(state)) thumbnails.advance();
      },
      current: () => currentDocument(state),
    },
    beginning,
  );
  const pictures = new Pictures({
    state,
    session,
    picture,
    takeInputTime: (inputSeq) => conversation.takeInputTime(inputSeq),
  });

  /** Calls `react` on every change of `value` that the server does not know yet. */
  const onEdit = (value: ReadonlySignal<unknown>, react: () => void): void => {
    let first = true;
    const stop = effect(() => {
      value.value;
      if (!first && !adopting) untracked(react);
      first = false;
    });
    ends.push(stop);
  };

  /** What one does not steer is put back, and said. */
  const guarded = <T>(read: () => T, write: (kept: T) => void, send: () => void): (() => void) => {
    let kept = read();
    ends.push(
      effect(() => {
        const value = read();
        if (adopting || untracked(() => whyNotSteering(state)) === undefined) kept = value;
      }),
    );
    return () => {
      const why = whyNotSteering(state);
      if (why === undefined) {
        send();
      } else {
        notify(state, "info", why);
        adopt(() => write(kept));
      }
    };
  };
  onEdit(
    computed(() => state.edit.value.present),
    guarded(
      () => state.edit.value,
      (kept) => {
        state.edit.value = kept;
      },
      () => conversation.mark("scene"),
    ),
  );
  onEdit(
    state.orbit,
    guarded(
      () => state.orbit.value,
      (kept) => {
        state.orbit.value = kept;
      },
      () => {
        conversation.mark("camera");
        page.moved();
      },
    ),
  );
  onEdit(state.viewport, () => {
    conversation.resized();
    refitCamera(state);
  });

  /** As text, so that only other code, or other data, is another question. */
  const codeQuestion = computed(() => JSON.stringify(codeToDescribe(state)) ?? "");
  ends.push(
    effect(() => {
      const question = codeQuestion.value;
      const isOpen = state.connection.value.kind === "open";
      if (!question || !isOpen) return;
      untracked(() => conversation.questions.describeShader(JSON.parse(question)));
    }),
  );

  ends.push(
    followSize(picture.element, (width, height) => {
      const size = limited(width, height, state.welcome.value?.limits?.maxSide || kMaxSide);
      const before = state.viewport.value;
      if (width === 0 || height === 0) return;
      if (before?.width === size.width && before.height === size.height) return;
      state.viewport.value = size;
    }),
  );

  ends.push(
    controlCamera(picture.element, {
      orbit: () => state.orbit.value,
      move(next, inputAt) {
        state.input.at = inputAt;
        state.orbit.value = next;
      },
      turn: (around) => page.turn(around),
      reset(inputAt) {
        state.input.at = inputAt;
        resetCamera(state);
      },
    }),
  );

  const probe = followProbe(picture.element, state, conversation.questions);
  ends.push(probe.end);

  const { people, questions } = conversation;
  const thumbnails = new ThumbnailKeeper(state, (request, scene) => {
    const { width, height } = thumbnailSize(devicePixelRatio);
    return questions.drawThumbnail(request, scene, width, height);
  });
  ends.push(
    followThumbnails(state, thumbnails),
    followTime(state, {
      now: () => performance.now(),
      after: (ms, run) => void setTimeout(run, ms),
    }),
    followPins(state, (pins) => questions.setPins(pins)),
    followIdle(state, {
      measure: () => questions.measure("measured"),
      stop: () => questions.stopMeasuring(),
      after(ms, run) {
        const timer = setTimeout(run, ms);
        return () => clearTimeout(timer);
      },
    }),
    effect(() => {
      if (needsComparison(state)) untracked(() => questions.compare());
    }),
  );
  const step = (isRedo: boolean): void => {
    const why = whyNotSteering(state);
    if (why) notify(state, "info", why);
    else if (state.serverSteps.value) conversation.step(isRedo);
    else if (isRedo) redo(state);
    else undo(state);
  };
  const port: ViewPort = {
    openDataset(id) {
      const document = currentDocument(state);
      const shown = state.layer.value?.dataset;
      if (document && shown) left.set(shown, document);
      conversation.open({ ...kAnything, dataset: id, document: left.get(id) });
    },
    drawAgain: () => conversation.drawAgain(),
    screenshot: () => void savePicture(state, pictures.screen),
    recordTurn: (wish) => void recordTurn(state, pictures.screen, wish),
    toggleProjection() {
      if (state.orbit.value) state.orbit.value = withOtherProjection(state.orbit.value);
    },
    resetCamera: () => resetCamera(state),
    explain: () => questions.explain(),
    measure: (aim) => questions.measure(aim),
    stopMeasuring: () => questions.stopMeasuring(),
    compare(on) {
      if (!on) questions.stopComparing();
      state.comparing.value = on;
      if (!on) state.difference.value = undefined;
    },
    undo: () => step(false),
    redo: () => step(true),
    takeControl: () => people.takeControl(),
    handOver: (person) => people.handOver(person),
    askControl: (withdraw) => people.askControl(withdraw),
    share: (role, expiresS) => people.share(role, expiresS),
    leave: () => conversation.leave(),
    saveScene: () => saveScene(state),
    async loadScene(file) {
      const saved = await loadedScene(state, file);
      if (saved) conversation.open(wishForScene(saved.scene, saved.edit));
    },
  };

  session.add(conversation);
  lastKey += 1;
  return {
    key: lastKey,
    state,
    togglePin: probe.togglePin,
    picture,
    pictures,
    conversation,
    port,
    adopt,
    close() {
      for (const end of ends) end();
      session.remove(conversation);
      pictures.close();
      picture.element.remove();
    },
  };
}
