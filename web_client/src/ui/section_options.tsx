import { RayModel } from "../net/gen/volcast/v1/scene_pb";
import { endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import { type AxisIndex, kAxisNames } from "../state/clip_planes";
import { isRefused } from "../state/refusal";
import { changeSection, sectionsOf } from "../state/voxel_actions";
import { Check, SliderField } from "./inputs";

const kAxes: readonly AxisIndex[] = [0, 1, 2];

/** Which planes across the axes are shown, and where. */
export function SectionOptions({ state }: { readonly state: AppState }) {
  const layer = state.layer.value;
  const bounds = state.bounds.value;
  if (layer?.model !== RayModel.CROSS_SECTIONS || !bounds) return null;
  const { point, shown } = sectionsOf(layer.crossSections, bounds);
  return (
    <>
      {/* biome-ignore lint/a11y/useSemanticElements: a rendered legend is no flex item */}
      <div class="line" role="group" aria-label="Planes across">
        <span>Planes across</span>
        {kAxes.map((axis) => (
          <Check
            key={axis}
            checked={shown[axis]}
            take={(on) => changeSection(state, axis, { shown: on })}
          >
            {kAxisNames[axis]}
          </Check>
        ))}
      </div>
      {kAxes.map(
        (axis) =>
          shown[axis] && (
            <SliderField
              key={axis}
              label={`At ${kAxisNames[axis]}`}
              value={point[axis]}
              low={bounds.min[axis]}
              high={bounds.max[axis]}
              invalid={isRefused(state, "cross_sections")}
              take={(position, gesture) => changeSection(state, axis, { position }, gesture)}
              done={() => endGesture(state)}
            />
          ),
      )}
    </>
  );
}
