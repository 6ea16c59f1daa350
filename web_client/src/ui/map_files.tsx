import { useSignal } from "@preact/signals";
import { fileNameOf, saveFile } from "../save_file";
import { axisOfSlot, drawnMap, fieldOf, mapEditOf } from "../state/actions";
import type { AppState } from "../state/app_state";
import { takeMapFile } from "../state/map_files";
import type { Slot } from "../state/models";
import { writeMap } from "../transfer/map_file";
import { writePreset } from "../transfer/paraview_map";

interface Props {
  readonly state: AppState;
  readonly slot: Slot;
}

const kMostBytes = 4 << 20;

/** A file of that kind, through the browser's own dialog. */
function chooseFile(take: (file: File) => void): void {
  const input = document.createElement("input");
  input.type = "file";
  input.accept = ".json,application/json";
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file) take(file);
  });
  input.click();
}

/** Maps go into files and come back from them: our own, and those of ParaView, VTK and vtk.js. */
export function MapFiles({ state, slot }: Props) {
  const problem = useSignal("");
  const name = fieldOf(state, slot)?.name ?? "map";
  const save = (json: unknown, end: string): void => {
    problem.value = "";
    const text = `${JSON.stringify(json, undefined, 2)}\n`;
    saveFile(new Blob([text], { type: "application/json" }), fileNameOf(name, end));
  };
  const open = async (file: File): Promise<void> => {
    try {
      if (file.size > kMostBytes) throw new Error(`it has more than ${kMostBytes >> 20} MB`);
      takeMapFile(state, slot, await file.text());
      problem.value = "";
    } catch (error) {
      const reason = error instanceof Error ? error.message : String(error);
      problem.value = `${file.name} is no map that can be read: ${reason}.`;
    }
  };
  return (
    <details class="advanced map-files">
      <summary>Files</summary>
      <div class="buttons">
        <button type="button" class="text-button" onClick={() => chooseFile((f) => void open(f))}>
          Open a map
        </button>
        <button
          type="button"
          class="text-button"
          onClick={() => save(writeMap(mapEditOf(state, slot), drawnMap(state, slot)), "map.json")}
        >
          Save as JSON
        </button>
        <button
          type="button"
          class="text-button"
          title="A colour map as ParaView, VTK and vtk.js read it"
          onClick={() => {
            const axis = axisOfSlot(state, slot);
            const length = state.referenceLength.value;
            save(writePreset(drawnMap(state, slot), name, length, axis), "paraview.json");
          }}
        >
          Save for ParaView
        </button>
      </div>
      <p class="hint">
        Opens these two, and presets of ParaView, VTK and vtk.js, which are laid over the map’s
        range.
      </p>
      <p class="problem" role="alert">
        {problem.value}
      </p>
    </details>
  );
}
