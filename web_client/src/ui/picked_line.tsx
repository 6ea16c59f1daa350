import type { Picked } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "../state/app_state";
import { toHex } from "../transfer/srgb";
import { formatNumber } from "./format";

interface Props {
  readonly state: AppState;
}

function placeOf(picked: Picked): string {
  const { x = 0, y = 0, z = 0 } = picked.position ?? {};
  return [x, y, z].map((c) => formatNumber(c, 5)).join(", ");
}

function itemOf(picked: Picked): string {
  if (picked.cell !== undefined) return `cell ${picked.cell}`;
  return picked.voxel.length === 3 ? `voxel ${picked.voxel.join(", ")}` : "";
}

/** What the picture shows under the pointer: value, place, and cell or voxel. */
export function PickedLine({ state }: Props) {
  const picked = state.picked.value;
  if (!picked?.layer) return null;
  const unitOf = (field: string): string =>
    state.dataset.value?.fields.find((f) => f.name === field)?.unit ?? "";
  return (
    <output class="picked">
      <span
        class="picked-colour"
        style={{ backgroundColor: picked.colour && toHex(picked.colour) }}
      />
      {picked.values.map(({ field, value }, i) => (
        <span key={field} class={i === 0 ? "picked-value" : undefined}>
          {field} {formatNumber(value, 6)} {unitOf(field)}
        </span>
      ))}
      <span>at {placeOf(picked)}</span>
      <span>{itemOf(picked)}</span>
    </output>
  );
}
