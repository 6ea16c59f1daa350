import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { AppState } from "../state/app_state";
import { notify } from "../state/app_state";
import { isUnderWay } from "../state/upload";
import { droppedFiles } from "./dropped_files";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

const holdsFiles = (event: DragEvent): boolean =>
  event.dataTransfer?.types.includes("Files") ?? false;

/** Takes files that are dropped anywhere on the window; shown while some are held over it. */
export function DropZone({ state, port }: Props) {
  const isOver = useSignal(false);
  useEffect(() => {
    const ended = new AbortController();
    const listen = (
      type: "dragenter" | "dragover" | "dragleave" | "drop",
      handle: (event: DragEvent) => void,
    ): void =>
      window.addEventListener(type, (event) => holdsFiles(event) && handle(event), {
        signal: ended.signal,
      });
    const show = (event: DragEvent): void => {
      event.preventDefault(); // Else the browser would open the file in the page's place.
      isOver.value = true;
    };
    listen("dragenter", show);
    listen("dragover", show);
    listen("dragleave", (event) => {
      // Without a next element it is the window that was left.
      if (!event.relatedTarget) isOver.value = false;
    });
    listen("drop", (event) => {
      event.preventDefault();
      isOver.value = false;
      const { dataTransfer } = event;
      if (!dataTransfer || !state.welcome.value?.uploads) {
        notify(state, "error", "This server takes no uploads.");
      } else if (isUnderWay(state.upload.value)) {
        notify(state, "error", "Another upload is still under way.");
      } else {
        droppedFiles(dataTransfer).then(
          ({ files, folder }) => port.upload(files, folder),
          (error: unknown) => notify(state, "error", `The drop could not be read: ${error}`),
        );
      }
    });
    return () => ended.abort();
  }, []);
  if (!isOver.value) return null;
  const takes = state.welcome.value?.uploads !== undefined;
  return (
    <div class="drop-zone">
      <p>{takes ? "Drop all files of one dataset to upload it" : "This server takes no uploads"}</p>
    </div>
  );
}
