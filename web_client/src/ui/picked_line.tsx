import { useSignal } from "@preact/signals";
import type { Picked } from "../net/gen/volcast/v1/session_pb";
import { type AppState, notify } from "../state/app_state";
import { pickedJson } from "../state/picked_json";
import { toHex } from "../transfer/srgb";
import { copyText } from "./copy_text";
import { formatNumber } from "./format";
import { IconButton } from "./icons";

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

/** Copies what is pinned, or lets it go. */
function PinTools({ state }: Props) {
  const copied = useSignal(false);
  const copy = async (): Promise<void> => {
    const { picked, dataset } = state;
    if (!picked.value?.layer) return;
    copied.value = await copyText(pickedJson(picked.value, dataset.value));
    if (!copied.value) notify(state, "error", "The browser did not let the values be copied.");
  };
  return (
    <span class="picked-tools">
      <button type="button" class="text-button" onClick={() => void copy()}>
        {copied.value ? "Copied" : "Copy as JSON"}
      </button>
      <IconButton
        icon="close"
        label="Let the place go"
        onClick={() => {
          state.pinned.value = undefined;
        }}
      />
    </span>
  );
}

/** What the picture shows under the pointer, or at a place that is kept: value, place, cell or voxel. */
export function PickedLine({ state }: Props) {
  const picked = state.picked.value;
  const pinned = state.pinned.value;
  if (!picked?.layer && !pinned) return null;
  const unitOf = (field: string): string =>
    state.dataset.value?.fields.find((f) => f.name === field)?.unit ?? "";
  return (
    <>
      {pinned && (
        <span
          class="pin"
          aria-hidden="true"
          style={{ left: `${100 * pinned.x}%`, top: `${100 * pinned.y}%` }}
        />
      )}
      <div class="picked" data-pinned={pinned ? "" : undefined}>
        <output>
          {picked?.layer ? (
            <>
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
            </>
          ) : (
            <span>No data at this place</span>
          )}
        </output>
        {pinned && <PinTools state={state} />}
      </div>
    </>
  );
}
