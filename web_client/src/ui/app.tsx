import { type Signal, useSignal } from "@preact/signals";
import { redo, undo } from "../state/actions";
import type { AppState } from "../state/app_state";
import { AccuracyPanel } from "./accuracy_panel";
import { BackgroundPicker } from "./background_picker";
import { BadgeView } from "./badge";
import { ChannelList } from "./channel_list";
import { ClipEditor } from "./clip_editor";
import { DataList } from "./data_list";
import { ExplainPanel } from "./explain_panel";
import { FieldPicker } from "./field_picker";
import { Help } from "./help";
import { Icon, IconButton } from "./icons";
import { lazy } from "./lazy";
import { MapEditor } from "./map_editor";
import { MeasurePanel } from "./measure_panel";
import { ModelPicker } from "./model_picker";
import { Notices } from "./notices";
import { PickedLine } from "./picked_line";
import type { AppPort } from "./port";
import { Readout } from "./readout";
import { RecordingChip } from "./recording_chip";
import { RefusalNote } from "./refusal_note";
import { ShaderPanel } from "./shader_panel";
import { ViewMenu } from "./view_menu";
import { VoxelPanel } from "./voxel_panel";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
  readonly helpOpen: Signal<boolean>;
  /** The element that the picture is drawn in; it outlives every rendering of the panels. */
  readonly picture: (host: HTMLElement | null) => void;
}

const Overlay = lazy(async () => (await import("./overlay")).Overlay);

const DropZone = lazy(async () => (await import("./drop_zone")).DropZone);

const Hud = lazy(async () => (await import("./hud")).Hud);

/** Fetched only where something of it is to be seen. */
function Overlays({ state }: { readonly state: AppState }) {
  const { axes, scaleBar, box, legend } = state.options.value;
  return axes || scaleBar || box || legend ? <Overlay state={state} /> : null;
}

function Tools({ state, port, helpOpen }: Omit<Props, "picture">) {
  const flat = state.orbit.value?.orthographic ?? false;
  return (
    <div class="tools" role="toolbar" aria-label="Picture">
      <IconButton icon="reset" label="Show everything" shortcut="R" onClick={port.resetCamera} />
      <IconButton
        icon={flat ? "orthographic" : "perspective"}
        label={flat ? "Orthographic: switch to perspective" : "Perspective: switch to orthographic"}
        shortcut="P"
        onClick={port.toggleProjection}
      />
      <ViewMenu state={state} port={port} />
      <IconButton icon="camera" label="Save the picture" shortcut="C" onClick={port.screenshot} />
      <IconButton
        icon="fullscreen"
        label="Full screen"
        shortcut="F"
        onClick={port.toggleFullscreen}
      />
      <IconButton
        icon="help"
        label="Controls"
        shortcut="?"
        onClick={() => {
          helpOpen.value = true;
        }}
      />
    </div>
  );
}

function Steps({ state }: { readonly state: AppState }) {
  const { past, future } = state.edit.value;
  return (
    <div class="steps">
      <IconButton
        icon="undo"
        label="Undo"
        shortcut="Control+Z"
        disabled={past.length === 0}
        onClick={() => undo(state)}
      />
      <IconButton
        icon="redo"
        label="Redo"
        shortcut="Control+Shift+Z"
        disabled={future.length === 0}
        onClick={() => redo(state)}
      />
    </div>
  );
}

function Footer({ state }: { readonly state: AppState }) {
  const welcome = state.welcome.value;
  return (
    <footer class="footer">
      <span>{welcome?.server || "Volcast"}</span>
      {welcome?.sourceUrl && (
        <a href={welcome.sourceUrl} target="_blank" rel="noreferrer">
          Source code (AGPL)
        </a>
      )}
    </footer>
  );
}

/** The page: the picture, and beside or below it the panel. */
export function App({ state, port, helpOpen, picture }: Props) {
  const open = useSignal(matchMedia("(min-width: 720px)").matches);
  return (
    <div class="page" data-panel={open.value ? "open" : "closed"}>
      <main class="stage">
        <div class="picture-host" ref={picture} />
        <Overlays state={state} />
        <Tools state={state} port={port} helpOpen={helpOpen} />
        <Readout state={state} />
        {state.options.value.hud && <Hud state={state} />}
        <RecordingChip state={state} />
        <PickedLine state={state} />
        <Notices state={state} />
      </main>
      <aside class="panel" aria-label="Settings">
        <header class="panel-head">
          <h1>Volcast</h1>
          <BadgeView state={state} port={port} />
          <Steps state={state} />
          <button
            type="button"
            class="icon-button sheet-toggle"
            aria-expanded={open.value}
            aria-controls="panel-body"
            aria-label={open.value ? "Hide the settings" : "Show the settings"}
            onClick={() => {
              open.value = !open.value;
            }}
          >
            <Icon name={open.value ? "down" : "up"} />
          </button>
        </header>
        <RefusalNote state={state} />
        <div id="panel-body" class="panel-body">
          <DataList state={state} port={port} />
          <ModelPicker state={state} />
          <FieldPicker state={state} />
          <ChannelList state={state} />
          <MapEditor state={state} slot="first" />
          <MapEditor state={state} slot="second" />
          <VoxelPanel state={state} />
          <ShaderPanel state={state} />
          <AccuracyPanel state={state} />
          <MeasurePanel state={state} port={port} />
          <ExplainPanel state={state} port={port} />
          <ClipEditor state={state} />
          <BackgroundPicker state={state} />
          <Footer state={state} />
        </div>
      </aside>
      <Help open={helpOpen} />
      <DropZone state={state} port={port} />
    </div>
  );
}
