import { type Signal, useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import type { Pane } from "../pane";
import { kMostPanes, type Panes } from "../panes";
import type { AppState } from "../state/app_state";
import { whyNotSteering } from "../state/people";
import { AccuracyPanel } from "./accuracy_panel";
import { BackgroundPicker } from "./background_picker";
import { BadgeView } from "./badge";
import { ChannelList } from "./channel_list";
import { ClipEditor } from "./clip_editor";
import { DataList } from "./data_list";
import { DifferencePanel } from "./difference_panel";
import { ExplainPanel } from "./explain_panel";
import { FieldPicker } from "./field_picker";
import { Help } from "./help";
import { Icon, IconButton } from "./icons";
import { lazy } from "./lazy";
import { MapEditor } from "./map_editor";
import { MeasurePanel } from "./measure_panel";
import { ModelPicker } from "./model_picker";
import { Notices } from "./notices";
import { PacePanel } from "./pace_panel";
import { PaneGrid } from "./pane_grid";
import type { AppPort } from "./port";
import { Readout } from "./readout";
import { RecordingChip } from "./recording_chip";
import { RefusalNote } from "./refusal_note";
import { ShaderPanel } from "./shader_panel";
import { SteerNote } from "./steer_note";
import { TimePanel } from "./time_panel";
import { ViewMenu } from "./view_menu";
import { VoxelPanel } from "./voxel_panel";

interface Props {
  readonly panes: Panes;
  readonly portOf: (pane: Pane) => AppPort;
  readonly helpOpen: Signal<boolean>;
  readonly shareOpen: Signal<boolean>;
}

interface ViewProps {
  readonly state: AppState;
  readonly port: AppPort;
}

const DropZone = lazy(async () => (await import("./drop_zone")).DropZone);

const Hud = lazy(async () => (await import("./hud")).Hud);

const ShareDialog = lazy(async () => (await import("./share_dialog")).ShareDialog);

function Tools({ state, port, panes, helpOpen, shareOpen }: ViewProps & Omit<Props, "portOf">) {
  const flat = state.orbit.value?.orthographic ?? false;
  const held = whyNotSteering(state);
  return (
    <div class="tools" role="toolbar" aria-label="Picture">
      <IconButton
        icon="reset"
        label="Show everything"
        shortcut="R"
        held={held}
        onClick={port.resetCamera}
      />
      <IconButton
        icon={flat ? "orthographic" : "perspective"}
        label={flat ? "Orthographic: switch to perspective" : "Perspective: switch to orthographic"}
        shortcut="P"
        held={held}
        onClick={port.toggleProjection}
      />
      <ViewMenu state={state} port={port} />
      <IconButton
        icon="beside"
        label="Another view beside this one"
        held={
          panes.all.value.length < kMostPanes
            ? undefined
            : `There are ${kMostPanes} views, the most.`
        }
        onClick={port.addView}
      />
      <IconButton icon="camera" label="Save the picture" shortcut="C" onClick={port.screenshot} />
      <IconButton
        icon="fullscreen"
        label="Full screen"
        shortcut="F"
        onClick={port.toggleFullscreen}
      />
      <IconButton
        icon="people"
        label="Share"
        onClick={() => {
          shareOpen.value = true;
        }}
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

/** Undo goes back over what was done here; once others may be in the view, over what anybody did. */
function Steps({ state, port }: ViewProps) {
  const { past, future } = state.edit.value;
  const server = state.serverSteps.value;
  const held = whyNotSteering(state);
  return (
    <div class="steps">
      <IconButton
        icon="undo"
        label="Undo"
        shortcut="Control+Z"
        held={held}
        disabled={server ? !server.canUndo : past.length === 0}
        onClick={port.undo}
      />
      <IconButton
        icon="redo"
        label="Redo"
        shortcut="Control+Shift+Z"
        held={held}
        disabled={server ? !server.canRedo : future.length === 0}
        onClick={port.redo}
      />
    </div>
  );
}

/** Sections that change the view; whoever does not steer it reads them only. */
function Settings({
  state,
  children,
}: {
  readonly state: AppState;
  readonly children: ComponentChildren;
}) {
  return (
    <fieldset class="settings" aria-label="Settings" disabled={whyNotSteering(state) !== undefined}>
      {children}
    </fieldset>
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

/** The page: the pictures, and beside or below them the panel of the active one. */
export function App({ panes, portOf, helpOpen, shareOpen }: Props) {
  const open = useSignal(matchMedia("(min-width: 720px)").matches);
  const active = panes.active.value;
  const { state, key } = active;
  const port = portOf(active);
  return (
    <div class="page" data-panel={open.value ? "open" : "closed"}>
      <main class="stage">
        <PaneGrid panes={panes} portOf={portOf} />
        <Tools state={state} port={port} panes={panes} helpOpen={helpOpen} shareOpen={shareOpen} />
        <Readout key={key} state={state} />
        {state.options.value.hud && <Hud key={key} state={state} />}
        <RecordingChip state={state} />
        <Notices state={state} />
      </main>
      <aside class="panel" aria-label="Settings">
        <header class="panel-head">
          <h1>Volcast</h1>
          <BadgeView key={key} state={state} port={port} />
          <Steps state={state} port={port} />
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
        <SteerNote state={state} port={port} />
        <RefusalNote state={state} />
        <div key={key} id="panel-body" class="panel-body">
          <Settings state={state}>
            <DataList state={state} port={port} />
            <ModelPicker state={state} />
            <FieldPicker state={state} />
            <TimePanel state={state} />
            <ChannelList state={state} />
            <MapEditor state={state} slot="first" />
            <MapEditor state={state} slot="second" />
            <VoxelPanel state={state} />
            <ShaderPanel state={state} />
            <AccuracyPanel state={state} port={port} />
          </Settings>
          <MeasurePanel state={state} port={port} />
          <DifferencePanel state={state} port={port} />
          <ExplainPanel state={state} port={port} />
          <PacePanel state={state} />
          <Settings state={state}>
            <ClipEditor state={state} />
            <BackgroundPicker state={state} />
          </Settings>
          <Footer state={state} />
        </div>
      </aside>
      <Help open={helpOpen} />
      <DropZone state={state} port={port} />
      {shareOpen.value && <ShareDialog key={key} state={state} port={port} open={shareOpen} />}
    </div>
  );
}
