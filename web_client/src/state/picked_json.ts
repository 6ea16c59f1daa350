import type { DatasetInfo, Picked } from "../net/gen/volcast/v1/session_pb";
import { toHex } from "../transfer/srgb";

/** What a pixel shows, as text for other programs: JSON with units, indented by two. */
export function pickedJson(picked: Picked, dataset: DatasetInfo | undefined): string {
  const { x = 0, y = 0, z = 0 } = picked.position ?? {};
  const unitOf = (field: string): string | undefined =>
    dataset?.fields.find((f) => f.name === field)?.unit || undefined;
  const json = {
    dataset: dataset?.id,
    layer: picked.layer,
    values: picked.values.map(({ field, value }) => ({ field, value, unit: unitOf(field) })),
    position: [x, y, z],
    distance: picked.distance,
    cell: picked.cell,
    voxel: picked.voxel.length === 3 ? picked.voxel : undefined,
    colour: picked.colour && toHex(picked.colour),
    pixel: [picked.x, picked.y],
  };
  return JSON.stringify(json, undefined, 2);
}
