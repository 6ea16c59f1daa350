import { signal } from "@preact/signals";
import { render } from "preact";
import { takeAccess } from "./access";
import { AddressBar, beginningsOf } from "./address_bar";
import { keepPage, takeKeptPage } from "./kept_page";
import { keepMyName, myName } from "./my_name";
import { Session } from "./net/session";
import type { Pane, PaneBeginning } from "./pane";
import { Panes } from "./panes";
import { currentDocument } from "./state/actions";
import { readAddress } from "./state/address";
import { createSharedState, notify } from "./state/app_state";
import type { KeptPage } from "./state/keeper";
import type { Stages } from "./state/recorder";
import { keepOptions, switched, type ViewOption } from "./state/view_options";
import { App } from "./ui/app";
import type { AppPort, PagePort } from "./ui/port";
import "./ui/style.css";
import type { ViewQuestions } from "./net/view_questions";
import { codecsHere } from "./video/codecs";
import { dragged, type Orbit } from "./view/camera";
import { controlFlight } from "./view/fly_control";
import { type KeyAction, meaningOf, takesKey } from "./view/keyboard";
import { levelled, looked, rolled, type Turn } from "./view/turning";

declare global {
  interface Window {
    /** For benchmarks: measurements in ms, oldest first, of input to drawn and of stages of pictures. */
    volcast: {
      latencies(): readonly number[];
      stages(): readonly Stages[];
      clearLatencies(): void;
      /** What pacing must not change, until the view is opened anew. */
      setPins(pins: Parameters<ViewQuestions["setPins"]>[0]): void;
    };
  }
}

const shared = createSharedState();
const helpOpen = signal(false);
const shareOpen = signal(false);
keepOptions(shared.options);

const access = takeAccess();
const kept = takeKeptPage();
const named = kept ? undefined : await readAddress(location.hash);

const keptBeginnings = ({ views, resume }: KeptPage): readonly PaneBeginning[] =>
  views.map((view) => ({ ...view, number: resume && view.number }));

const session = new Session({
  url: `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/v1/ws`,
  state: shared,
  codecs: codecsHere(),
  person: myName,
  access,
  resume: kept?.resume,
  patch: (frame) => panes.all.value[0]?.pictures.tryPatch(frame),
});
const panes = new Panes(
  { session, shared, turn },
  kept ? keptBeginnings(kept) : beginningsOf(named?.places ?? [], shared),
);
panes.linked.value = kept?.linked ?? named?.linked ?? true;
const addressBar = new AddressBar(panes, shared);
const active = () => panes.active.value;

const pagePort: PagePort = {
  importAgain: (id) => session.importAgain(id),
  drawDatasetThumbnail: (id) => session.drawDatasetThumbnail(id),
  upload: (files, folder) => void sendFiles(files, folder),
  reconnect: () => session.connect(),
  toggle: (name) => toggleOption(name),
  toggleFullscreen() {
    const stage = active().picture.element.closest(".stage");
    const change = document.fullscreenElement
      ? document.exitFullscreen()
      : stage?.requestFullscreen();
    change?.catch((error: unknown) => notify(shared, "info", `No full screen: ${String(error)}`));
  },
  rename(person) {
    keepMyName(person);
    session.rename(person);
  },
  addView() {
    const document = currentDocument(active().state);
    const pane = panes.add({ document });
    if (pane) panes.activate(pane);
  },
  closeView(key) {
    const pane = panes.all.value.find((p) => p.key === key);
    if (pane) panes.close(pane);
  },
  activate(key) {
    const pane = panes.all.value.find((p) => p.key === key);
    if (pane) panes.activate(pane);
  },
  linkCameras(on) {
    panes.linked.value = on;
  },
  url: () => addressBar.url(),
};

/** Shows what was uploaded, in the active view, as soon as the server lists it. */
async function sendFiles(files: readonly File[], folder: string | undefined): Promise<void> {
  const { upload } = await import("./state/send_upload");
  await upload(
    shared,
    access,
    files,
    folder,
    ([first]) => first && active().port.openDataset(first),
  );
}

const camera = {
  orbit: () => active().state.orbit.value,
  move(next: Orbit, inputAt: number): void {
    const { state } = active();
    state.input.at = inputAt;
    state.orbit.value = next;
  },
};
const flight = controlFlight(camera);

function turn(around: boolean): Turn {
  if (around || flight.flying()) return looked;
  return shared.options.value.trackball ? rolled : dragged;
}

/** A turntable that follows a trackball stands upright again. */
function toggleOption(name: ViewOption): void {
  shared.options.value = switched(shared.options.value, name);
  if (name !== "trackball" || shared.options.value.trackball) return;
  for (const { state } of panes.all.value) {
    const { orbit, home } = state;
    if (orbit.value && home.value) orbit.value = levelled(orbit.value, home.value.axis);
  }
}

const kKeyActions: Readonly<Record<KeyAction, () => void>> = {
  reset: () => active().port.resetCamera(),
  fullscreen: pagePort.toggleFullscreen,
  help: () => {
    helpOpen.value = true;
  },
  undo: () => active().port.undo(),
  redo: () => active().port.redo(),
  save: () => active().port.screenshot(),
  trackball: () => toggleOption("trackball"),
  box: () => toggleOption("box"),
  legend: () => toggleOption("legend"),
  hud: () => toggleOption("hud"),
  pin: () => active().togglePin(),
};

window.addEventListener("keydown", (event) => {
  if (event.defaultPrevented || takesKey(event.target, event.key)) return;
  const meaning = meaningOf(event, turn(false));
  if (!meaning) return;
  event.preventDefault();
  const { state } = active();
  state.input.at = event.timeStamp;
  if ("do" in meaning) kKeyActions[meaning.do]();
  else if (state.orbit.value) state.orbit.value = meaning.move(state.orbit.value);
});

window.addEventListener("online", () => session.connect());
document.addEventListener("visibilitychange", () => {
  if (document.visibilityState === "visible") session.connect();
});

keepPage(session, panes);
window.volcast = {
  latencies: () => active().pictures.recorder.latencies(),
  stages: () => active().pictures.recorder.stages(),
  clearLatencies: () => active().pictures.recorder.clear(),
  setPins: (pins) => active().conversation.questions.setPins(pins),
};

const app = document.getElementById("app");
if (app) {
  const portOf = ({ port }: Pane): AppPort => ({ ...port, ...pagePort });
  render(<App panes={panes} portOf={portOf} helpOpen={helpOpen} shareOpen={shareOpen} />, app);
}
session.connect();
