import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import type { ClipPlane } from "../net/gen/volcast/v1/scene_pb";
import { changeScene, endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import {
  type BoxGrip,
  boxDraggedBy,
  boxMoveByKey,
  boxOf,
  middleOfBox,
  moveBox,
} from "../state/clip_box";
import {
  draggedTo,
  type Grip,
  type Handle,
  handleOf,
  moveHandle,
  placeByKey,
  removePlane,
} from "../state/clip_handles";
import type { Bounds, Orbit } from "../view/camera";
import { planeOutline } from "../view/plane_outline";
import { type PicturePoint, projected } from "../view/project";
import { formatValue } from "./format";

interface Props {
  readonly state: AppState;
}

interface PlaneProps extends Props {
  readonly index: number;
  readonly handle: Handle;
  readonly orbit: Orbit;
}

/** Where a pointer is in the square that is as high as the picture and in its middle. */
function pictureAt(event: PointerEvent): PicturePoint | undefined {
  const square = (event.currentTarget as HTMLElement).closest(".clip-handles");
  const box = square?.getBoundingClientRect();
  if (!box) return undefined;
  return {
    x: (event.clientX - box.left) / box.width - 0.5,
    y: (event.clientY - box.top) / box.height - 0.5,
  };
}

/** What drags a handle: `take` says what is kept of where it was taken, `move` goes on from that. */
function useDrag<T extends object>(
  state: AppState,
  take: (from: PicturePoint) => T,
  move: (grip: T, to: PicturePoint) => void,
) {
  const grip = useRef<T | undefined>(undefined);
  const release = (): void => {
    if (grip.current) endGesture(state);
    grip.current = undefined;
  };
  return {
    onPointerDown(e: JSX.TargetedPointerEvent<HTMLElement>) {
      const from = pictureAt(e);
      if (!from || e.button !== 0) return;
      e.currentTarget.setPointerCapture(e.pointerId);
      grip.current = take(from);
    },
    onPointerMove(e: JSX.TargetedPointerEvent<HTMLElement>) {
      const to = pictureAt(e);
      if (grip.current && to) move(grip.current, to);
    },
    onPointerUp: release,
    onPointerCancel: release,
    onBlur: () => endGesture(state),
  };
}

/** A plane's handle: moved by mouse, by touch and by keys. */
function PlaneHandle({ state, index, handle, orbit }: PlaneProps) {
  const drag = useDrag<Grip>(
    state,
    (from) => ({ handle, orbit, from }),
    (grip, to) => moveHandle(state, index, draggedTo(grip, to)),
  );
  const at = projected(orbit, handle.at);
  if (!at) return null;
  const { low, high, place, name } = handle;
  return (
    <div
      class="clip-handle"
      role="slider"
      tabIndex={0}
      aria-label={name}
      aria-valuemin={low}
      aria-valuemax={high}
      aria-valuenow={place}
      aria-valuetext={formatValue(place, high - low)}
      data-index={index}
      data-axis={name.slice(-1)}
      style={{ left: `${100 * (0.5 + at.x)}%`, top: `${100 * (0.5 + at.y)}%` }}
      {...drag}
      onKeyDown={(e) => {
        const next = placeByKey(handle, e.key, e.shiftKey);
        if (next === undefined && e.key !== "Delete") return;
        e.preventDefault();
        e.stopPropagation();
        if (next === undefined) removePlane(state, index);
        else moveHandle(state, index, next);
      }}
    />
  );
}

interface BoxProps extends Props {
  readonly box: Bounds;
  readonly bounds: Bounds;
  readonly orbit: Orbit;
}

/** The middle of a clip box, which moves all of it: by mouse, by touch and by keys. */
function BoxHandle({ state, box, bounds, orbit }: BoxProps) {
  const drag = useDrag<BoxGrip>(
    state,
    (from) => ({ box, orbit, from }),
    (grip, to) => moveBox(state, grip.box, boxDraggedBy(grip, to)),
  );
  const at = projected(orbit, middleOfBox(box));
  if (!at) return null;
  const place = middleOfBox(box).map((x, i) =>
    formatValue(x, (bounds.max[i] ?? 0) - (bounds.min[i] ?? 0)),
  );
  return (
    <button
      type="button"
      class="clip-handle"
      data-box=""
      aria-label={`Clip box, all of it; middle ${place.join(", ")}`}
      title="Move the box: drag, arrows, Page Up and Down"
      style={{ left: `${100 * (0.5 + at.x)}%`, top: `${100 * (0.5 + at.y)}%` }}
      {...drag}
      onKeyDown={(e) => {
        const by = boxMoveByKey(orbit, bounds, e.key, e.shiftKey);
        if (!by && e.key !== "Delete") return;
        e.preventDefault();
        e.stopPropagation();
        if (by) moveBox(state, box, by);
        else changeScene(state, { clipPlanes: [] });
      }}
    />
  );
}

/** Where a plane cuts the data's bounds; nothing where a part of that lies behind the eye. */
function Outline({
  plane,
  orbit,
  bounds,
}: {
  plane: Handle["plane"];
  orbit: Orbit;
  bounds: Bounds;
}) {
  const corners = planeOutline(plane, bounds).map((p) => projected(orbit, p));
  if (corners.length === 0 || corners.some((p) => !p)) return null;
  return <polygon points={corners.map((p) => `${p?.x},${p?.y}`).join(" ")} />;
}

/** The clip planes as outlines with handles, drawn by the camera of the picture. */
export function ClipHandles({ state }: Props) {
  const orbit = state.shownOrbit.value;
  const bounds = state.bounds.value;
  const planes = state.scene.value?.clipPlanes ?? [];
  if (!orbit || !bounds) return null;
  const handles = planes.map((plane: ClipPlane, i) => handleOf(plane, i, bounds));
  const box = boxOf(planes);
  return (
    <div class="overlay">
      <svg class="box-overlay clip-outlines" viewBox="-0.5 -0.5 1 1" aria-hidden="true">
        {handles.map(
          (h, i) => h && <Outline key={i} plane={h.plane} orbit={orbit} bounds={bounds} />,
        )}
      </svg>
      {/* biome-ignore lint/a11y/useSemanticElements: a fieldset cannot be laid over the picture */}
      <div class="clip-handles" role="group" aria-label="Clip planes">
        {handles.map(
          (h, i) => h && <PlaneHandle key={i} state={state} index={i} handle={h} orbit={orbit} />,
        )}
        {box && <BoxHandle state={state} box={box} bounds={bounds} orbit={orbit} />}
      </div>
    </div>
  );
}
