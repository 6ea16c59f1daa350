import { computed, effect, type ReadonlySignal, signal, untracked } from "@preact/signals";
import { render } from "preact";
import type { Frame } from "./net/framing";
import { Codec } from "./net/gen/volcast/v1/frame_pb";
import { Session } from "./net/session";
import { followProbe } from "./probe";
import { recordTurn } from "./record_turn";
import { savePicture } from "./save_picture";
import {
  adoptScene,
  currentDocument,
  redo,
  refitCamera,
  resetCamera,
  restoreDocument,
  undo,
} from "./state/actions";
import { createAppState, notify, type PictureInfo } from "./state/app_state";
import type { ViewDocument } from "./state/document";
import { keepDocument, keptDocument } from "./state/keeper";
import { Recorder, type Stages } from "./state/recorder";
import { keepSample, sampleOf } from "./state/samples";
import { codeToDescribe } from "./state/shader_actions";
import { followShownOrbit } from "./state/shown_orbit";
import { keepOptions, switched, type ViewOption } from "./state/view_options";
import { App } from "./ui/app";
import type { AppPort } from "./ui/port";
import "./ui/style.css";
import { codecsHere } from "./video/codecs";
import { openScreen } from "./video/screen";
import type { EncodedPicture, PictureReport } from "./video/worker_messages";
import { dragged, type Orbit, withOtherProjection } from "./view/camera";
import { controlCamera } from "./view/camera_control";
import { controlFlight } from "./view/fly_control";
import { type KeyAction, meaningOf, takesKey } from "./view/keyboard";
import { createPictureElement, keepHeight } from "./view/picture_element";
import { levelled, looked, rolled, type Turn } from "./view/turning";
import { followSize, limited } from "./view/viewport";

declare global {
  interface Window {
    /** For benchmarks: measurements in ms, oldest first, of input to drawn and of stages of pictures. */
    volcast: {
      latencies(): readonly number[];
      stages(): readonly Stages[];
      clearLatencies(): void;
      /** What pacing must not change, until the view is opened anew. */
      setPins(pins: Parameters<Session["setPins"]>[0]): void;
    };
  }
}

const kMaxSide = 8192;
const state = createAppState();
const helpOpen = signal(false);
const picture = createPictureElement();
const recorder = new Recorder(state);
const screen = openScreen(
  picture.canvas,
  reported,
  ({ codec, rgb, error }) => session.patchDecoded(codec, rgb, error),
  (reason) => notify(state, "error", `Pictures cannot be shown: ${reason}`),
);

/** Frames that the screen works on, by view and sequence. */
const underway = new Map<string, { frame: Frame; bytes: number }>();
/** Views of datasets that were left, to come back to. */
const left = new Map<string, ViewDocument>();
/** True while signals take over what the server has already. */
let adopting = false;

keepOptions(state.options);
const shownOrbit = followShownOrbit(state);

const kept = keptDocument();
if (kept) restoreDocument(state, kept);

const address = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/v1/ws`;
const session = new Session(address, state, codecsHere(), {
  frame(frame, receivedAt) {
    const { view, sequence } = frame.prefix;
    underway.set(`${view} ${sequence}`, { frame, bytes: frame.payload.length });
    screen.show(encodedPicture(frame, receivedAt));
  },
  patch: (frame) => screen.tryPatch(encodedPicture(frame, 0)),
  opened(scene) {
    adopt(() => adoptScene(state, scene));
    shownOrbit.opened();
    if (state.orbit.value !== state.home.value) session.mark("camera");
  },
  restored(document) {
    adopt(() => restoreDocument(state, document));
    shownOrbit.opened();
  },
  current: () => currentDocument(state),
});

function encodedPicture({ prefix, header, payload }: Frame, receivedAt: number): EncodedPicture {
  const { view, sequence } = prefix;
  const { codec, width, height, keyframe, lossless, pixelsXxh32 } = header;
  const about = { codec, width, height, keyframe, lossless, pixelsXxh32 };
  return { view, sequence, ...about, payload, receivedAt };
}

function adopt(change: () => void): void {
  adopting = true;
  change();
  adopting = false;
}

function reported(report: PictureReport): void {
  const id = `${report.view} ${report.sequence}`;
  const item = underway.get(id);
  underway.delete(id);
  const holdMs = report.doneAt - report.receivedAt;
  const { view, sequence, decodeMs, queue, keyframeNeeded } = report;
  session.acknowledge(view, sequence, holdMs, decodeMs, queue, keyframeNeeded);
  if (report.kind === "failed" && !keyframeNeeded) {
    notify(state, "error", `Picture ${report.sequence} could not be decoded: ${report.reason}`);
  }
  if (report.kind !== "drawn" || !item) return;
  const { header } = item.frame;
  const drawnAt = report.doneAt - performance.timeOrigin;
  const inputAt = session.takeInputTime(header.inputSeq);
  recorder.drawn(drawnAt, inputAt);
  keepSample(
    state,
    sampleOf({
      header,
      bytes: item.bytes,
      at: drawnAt,
      latency: inputAt === undefined ? undefined : drawnAt - inputAt,
      holdMs,
      decodeMs: report.decodeMs,
    }),
  );
  if (header.redrawn && header.timings) {
    const { waitMs, uploadMs, drawMs, readbackMs, encodeMs, queueMs } = header.timings;
    recorder.took({
      wait: waitMs,
      upload: uploadMs,
      draw: drawMs,
      readback: readbackMs,
      encode: encodeMs,
      queue: queueMs,
      decode: report.decodeMs,
    });
  }
  const shown: PictureInfo = {
    ...header,
    view: report.view,
    timings: header.timings,
    bytes: item.bytes,
    decodeMs: report.decodeMs,
    exact: report.exact,
  };
  state.picture.value = shown;
  const { dataset } = picture.element;
  dataset.view = String(report.view);
  dataset.sequence = String(report.sequence);
  dataset.inputSeq = String(header.inputSeq);
  dataset.lossless = String(header.lossless);
  dataset.exact = String(report.exact ?? "");
  dataset.codec = Codec[header.codec] ?? "";
  dataset.workerGeneration = String(header.workerGeneration);
  dataset.size = `${header.width}x${header.height}`;
  keepHeight(picture, header.width / Math.max(1, header.height));
}

/** Calls `react` on every change of `value` that the server does not know yet. */
function onEdit(value: ReadonlySignal<unknown>, react: () => void): void {
  let first = true;
  effect(() => {
    value.value;
    if (!first && !adopting) untracked(react);
    first = false;
  });
}

onEdit(
  computed(() => state.edit.value.present),
  () => session.mark("scene"),
);
onEdit(state.orbit, () => session.mark("camera"));
onEdit(state.viewport, () => {
  session.resized();
  refitCamera(state);
});

/** As text, so that only other code, or other data, is another question. */
const codeQuestion = computed(() => JSON.stringify(codeToDescribe(state)) ?? "");
effect(() => {
  const question = codeQuestion.value;
  const isOpen = state.connection.value.kind === "open";
  if (question && isOpen) untracked(() => session.describeShader(JSON.parse(question)));
});

const port: AppPort = {
  openDataset(id) {
    const document = currentDocument(state);
    const shown = state.layer.value?.dataset;
    if (document && shown) left.set(shown, document);
    session.open(id, left.get(id));
  },
  importAgain: (id) => session.importAgain(id),
  drawThumbnail: (id) => session.drawThumbnail(id),
  upload: (files, folder) => void sendFiles(files, folder),
  drawAgain: () => session.drawAgain(),
  reconnect: () => session.connect(),
  screenshot: () => void savePicture(state, screen),
  recordTurn: (wish) => void recordTurn(state, screen, wish),
  toggleProjection() {
    if (state.orbit.value) state.orbit.value = withOtherProjection(state.orbit.value);
  },
  resetCamera: () => resetCamera(state),
  explain: () => session.explain(),
  measureAccuracy: () => session.measureAccuracy(),
  stopMeasuring: () => session.stopMeasuring(),
  toggle: (name) => toggleOption(name),
  toggleFullscreen() {
    const change = document.fullscreenElement
      ? document.exitFullscreen()
      : picture.element.closest(".stage")?.requestFullscreen();
    change?.catch((error: unknown) => notify(state, "info", `No full screen: ${String(error)}`));
  },
};

/** Shows what was uploaded as soon as the server lists it. */
async function sendFiles(files: readonly File[], folder: string | undefined): Promise<void> {
  const { upload } = await import("./state/send_upload");
  await upload(state, files, folder, ([first]) => first && port.openDataset(first));
}

followSize(picture.element, (width, height) => {
  const size = limited(width, height, state.welcome.value?.limits?.maxSide || kMaxSide);
  const before = state.viewport.value;
  if (width === 0 || height === 0) return;
  if (before?.width === size.width && before.height === size.height) return;
  state.viewport.value = size;
});

const camera = {
  orbit: () => state.orbit.value,
  move(next: Orbit, inputAt: number): void {
    state.input.at = inputAt;
    state.orbit.value = next;
  },
};
const flight = controlFlight(camera);

function turn(around: boolean): Turn {
  if (around || flight.flying()) return looked;
  return state.options.value.trackball ? rolled : dragged;
}

controlCamera(picture.element, {
  ...camera,
  turn,
  reset(inputAt) {
    state.input.at = inputAt;
    resetCamera(state);
  },
});

const probe = followProbe(picture.element, state, session);

/** A turntable that follows a trackball stands upright again. */
function toggleOption(name: ViewOption): void {
  state.options.value = switched(state.options.value, name);
  const { orbit, home, options } = state;
  if (name === "trackball" && !options.value.trackball && orbit.value && home.value) {
    orbit.value = levelled(orbit.value, home.value.axis);
  }
}

const kKeyActions: Readonly<Record<KeyAction, () => void>> = {
  reset: port.resetCamera,
  fullscreen: port.toggleFullscreen,
  help: () => {
    helpOpen.value = true;
  },
  undo: () => undo(state),
  redo: () => redo(state),
  save: port.screenshot,
  trackball: () => toggleOption("trackball"),
  box: () => toggleOption("box"),
  legend: () => toggleOption("legend"),
  hud: () => toggleOption("hud"),
  pin: () => probe.togglePin(),
};

window.addEventListener("keydown", (event) => {
  if (event.defaultPrevented || takesKey(event.target, event.key)) return;
  const meaning = meaningOf(event, turn(false));
  if (!meaning) return;
  event.preventDefault();
  state.input.at = event.timeStamp;
  if ("do" in meaning) kKeyActions[meaning.do]();
  else if (state.orbit.value) state.orbit.value = meaning.move(state.orbit.value);
});

window.addEventListener("online", () => session.connect());
document.addEventListener("visibilitychange", () => {
  if (document.visibilityState === "visible") session.connect();
});

keepDocument(state);
window.volcast = {
  latencies: () => recorder.latencies(),
  stages: () => recorder.stages(),
  clearLatencies: () => recorder.clear(),
  setPins: (pins) => session.setPins(pins),
};

const app = document.getElementById("app");
if (app) {
  const mount = (host: HTMLElement | null): void => host?.append(picture.element);
  render(<App state={state} port={port} helpOpen={helpOpen} picture={mount} />, app);
}
session.connect();
