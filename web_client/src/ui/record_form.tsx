import { useSignal } from "@preact/signals";
import type { AppState } from "../state/app_state";
import { picturesWithin, type TurnWish } from "../state/recording";
import { NumberLine, SelectLine } from "./inputs";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
  readonly begun: () => void;
}

const kPictures = 120;
const kVideo = typeof MediaRecorder === "function";

/** What a recorded turn is to be. */
export function RecordForm({ state, port, begun }: Props) {
  const pictures = useSignal(kPictures);
  const format = useSignal<TurnWish["format"]>(kVideo ? "webm" : "png");
  const formats: readonly (readonly [TurnWish["format"], string])[] = [
    ...(kVideo ? [["webm", "Video (WebM)"] as const] : []),
    ["png", "Lossless pictures (PNG)"],
  ];
  return (
    <fieldset>
      <legend>Record a turn</legend>
      <NumberLine
        label="Pictures"
        text={String(pictures.value)}
        take={(count) => {
          pictures.value = picturesWithin(count);
        }}
      />
      <SelectLine
        label="Save as"
        value={format.value}
        options={formats}
        take={(next) => {
          format.value = next;
        }}
      />
      <button
        type="button"
        class="text-button"
        disabled={state.recording.value !== undefined}
        onClick={() => {
          port.recordTurn({ pictures: pictures.value, format: format.value });
          begun();
        }}
      >
        Record
      </button>
    </fieldset>
  );
}
