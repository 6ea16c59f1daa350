import type { Pane } from "../pane";
import type { Panes } from "../panes";
import type { AppState } from "../state/app_state";
import { badgeOf } from "../state/badge";
import { whyNotSteering } from "../state/people";
import { IconButton } from "./icons";
import { Check } from "./inputs";
import { lazy } from "./lazy";
import { PickedLine } from "./picked_line";
import type { AppPort } from "./port";

interface Props {
  readonly panes: Panes;
  readonly portOf: (pane: Pane) => AppPort;
}

const Overlay = lazy(async () => (await import("./overlay")).Overlay);

const Difference = lazy(async () => (await import("./difference_overlay")).DifferenceOverlay);

const ClipHandles = lazy(async () => (await import("./overlay_clip")).ClipHandles);

/** Whoever does not steer has nothing to hold. */
const hasHandles = (state: AppState): boolean =>
  state.options.value.handles &&
  (state.scene.value?.clipPlanes.length ?? 0) > 0 &&
  whyNotSteering(state) === undefined;

/** Fetched only where something of it is to be seen. */
function Overlays({ state }: Pick<Pane, "state">) {
  const { axes, scaleBar, box, legend } = state.options.value;
  return axes || scaleBar || box || legend ? <Overlay state={state} /> : null;
}

interface HeadProps {
  readonly pane: Pane;
  readonly number: number;
  readonly active: boolean;
  readonly port: AppPort;
}

/** Which view it is, how it is, and its end; only where there are several. */
function PaneHead({ pane, number, active, port }: HeadProps) {
  const { state, key } = pane;
  const badge = badgeOf(state, performance.now());
  return (
    <header class="pane-head">
      <button
        type="button"
        class="pane-name"
        aria-pressed={active}
        title="Show the settings of this view"
        onClick={() => port.activate(key)}
      >
        <span class="pane-dot" data-state={badge.kind} aria-hidden="true" />
        <span class="pane-label">
          {number}: {state.dataset.value?.name ?? "Loading"}
        </span>
        <span class="spoken">, {badge.label}</span>
      </button>
      <IconButton icon="close" label={`Close view ${number}`} onClick={() => port.closeView(key)} />
    </header>
  );
}

/** The views, side by side; the element that a picture is drawn in outlives every rendering. */
export function PaneGrid({ panes, portOf }: Props) {
  const all = panes.all.value;
  const several = all.length > 1;
  return (
    <div class="panes" data-count={all.length}>
      {all.map((pane, i) => {
        const active = pane === panes.active.value;
        return (
          <section
            key={pane.key}
            class="pane"
            aria-label={several ? `View ${i + 1}` : "View"}
            data-active={several && active ? "" : undefined}
          >
            <div
              class="picture-host"
              ref={(host) => {
                const { element } = pane.picture;
                if (host && element.parentNode !== host) host.append(element);
              }}
            />
            {pane.state.comparing.value && <Difference state={pane.state} port={portOf(pane)} />}
            <Overlays state={pane.state} />
            {hasHandles(pane.state) && <ClipHandles state={pane.state} />}
            <PickedLine state={pane.state} />
            {several && active && <div class="pane-frame" />}
            {several && <PaneHead pane={pane} number={i + 1} active={active} port={portOf(pane)} />}
          </section>
        );
      })}
      {several && (
        <div class="panes-link">
          <Check checked={panes.linked.value} take={portOf(panes.active.value).linkCameras}>
            Cameras together
          </Check>
        </div>
      )}
    </div>
  );
}
