import { create } from "@bufbuild/protobuf";
import { type ClipPlane, ClipPlaneSchema } from "../net/gen/volcast/v1/scene_pb";
import { changeScene, endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { boxPlanes } from "../state/clip_handles";
import {
  type AxisIndex,
  axisPlaneOf,
  kAxisNames,
  kMostPlanes,
  nextPlane,
  planeMessage,
} from "../state/clip_planes";
import { isRefused } from "../state/refusal";
import type { Bounds } from "../view/camera";
import { IconButton } from "./icons";
import { SliderField } from "./inputs";

interface RowProps {
  readonly state: AppState;
  readonly bounds: Bounds;
  readonly index: number;
  readonly plane: ClipPlane;
  readonly change: (plane: ClipPlane | undefined, gesture?: string) => void;
}

function AxisRow({ state, bounds, index, plane, change }: RowProps) {
  const known = axisPlaneOf(plane);
  if (!known) return <p class="hint">Plane {index + 1} is oblique.</p>;
  const { axis, position, below } = known;
  const set = (part: Partial<typeof known>, gesture?: string): void =>
    change(planeMessage({ ...known, ...part }), gesture);
  const turn = (next: AxisIndex): void =>
    set({ axis: next, position: (bounds.min[next] + bounds.max[next]) / 2 });
  return (
    <>
      <select
        aria-label={`Axis of plane ${index + 1}`}
        value={String(axis)}
        onChange={(e) => turn(Number(e.currentTarget.value) as AxisIndex)}
      >
        {kAxisNames.map((name, i) => (
          <option key={name} value={String(i)}>
            {name}
          </option>
        ))}
      </select>
      <SliderField
        label={`Plane ${index + 1}`}
        value={position}
        low={bounds.min[axis]}
        high={bounds.max[axis]}
        invalid={isRefused(state, "clip_planes")}
        take={(at, gesture) => set({ position: at }, gesture)}
        done={() => endGesture(state)}
      />
      <IconButton
        icon="flip"
        label={`Plane ${index + 1}: keep ${below ? "above" : "below"} instead of ${below ? "below" : "above"}`}
        onClick={() => set({ below: !below })}
      />
    </>
  );
}

/** Planes across the axes that cut the data open. */
export function ClipEditor({ state }: { readonly state: AppState }) {
  const scene = state.scene.value;
  const bounds = state.bounds.value;
  if (!scene || !bounds) return null;
  const planes = scene.clipPlanes;
  const change = (at: number, plane: ClipPlane | undefined, gesture?: string): void => {
    const next = planes.flatMap((p, i) => (i === at ? (plane ? [plane] : []) : [p]));
    changeScene(state, { clipPlanes: next }, gesture && `${gesture} ${at}`);
  };
  const add = (): void => {
    const plane = create(ClipPlaneSchema, planeMessage(nextPlane(planes, bounds)));
    changeScene(state, { clipPlanes: [...planes, plane] });
  };
  const replace = (next: readonly ClipPlane[]): void =>
    changeScene(state, { clipPlanes: [...next] });
  return (
    <section class="section" aria-labelledby="clip-heading">
      <div class="section-head">
        <h2 id="clip-heading">Clipping</h2>
        {planes.length > 1 && (
          <button type="button" class="text-button push" onClick={() => replace([])}>
            Remove all
          </button>
        )}
        <IconButton icon="box" label="Clip to a box" onClick={() => replace(boxPlanes(bounds))} />
        <IconButton
          icon="add"
          label="Add a clip plane"
          disabled={planes.length >= kMostPlanes}
          onClick={add}
        />
      </div>
      {planes.length > 0 && (
        <ul class="planes">
          {planes.map((plane, i) => (
            <li key={i} class="plane">
              <AxisRow
                state={state}
                bounds={bounds}
                index={i}
                plane={plane}
                change={(next, gesture) => change(i, next, gesture)}
              />
              <IconButton
                icon="remove"
                label={`Remove plane ${i + 1}`}
                onClick={() => change(i, undefined)}
              />
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}
