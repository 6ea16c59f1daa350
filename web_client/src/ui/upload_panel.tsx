import { useRef } from "preact/hooks";
import type { AppState } from "../state/app_state";
import { isUnderWay } from "../state/upload";
import { formatBytes } from "./format";
import { Icon, IconButton } from "./icons";
import type { AppPort } from "./port";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
}

/** What is being sent, or why it was not taken. */
function Progress({ state }: { readonly state: AppState }) {
  const upload = state.upload.value;
  if (!upload) return null;
  const { name, sentBytes, totalBytes, file, error, cancel } = upload;
  if (error !== undefined) {
    return (
      <div class="upload" role="alert">
        <p class="dataset-error">
          <Icon name="warning" />
          <span>
            {name} was not taken: {error}.
          </span>
          <IconButton
            icon="close"
            label="Hide"
            onClick={() => {
              state.upload.value = undefined;
            }}
          />
        </p>
      </div>
    );
  }
  const percent = totalBytes > 0 ? Math.floor((100 * sentBytes) / totalBytes) : 100;
  return (
    <div class="upload">
      <div class="upload-head">
        <span class="dataset-name">{name}</span>
        <button type="button" class="text-button" onClick={cancel}>
          Cancel
        </button>
      </div>
      <div class="dataset-progress">
        <progress max={100} value={percent} aria-label={`Uploading ${name}`} />
        <span>
          {file}, {formatBytes(sentBytes)} of {formatBytes(totalBytes)}
        </span>
      </div>
    </div>
  );
}

/** Files of the person's own, for a server that takes them. */
export function UploadPanel({ state, port }: Props) {
  const input = useRef<HTMLInputElement>(null);
  const limits = state.welcome.value?.uploads;
  if (!limits) return null;
  return (
    <div class="uploads">
      <Progress state={state} />
      <button
        type="button"
        class="text-button upload-button"
        disabled={isUnderWay(state.upload.value)}
        title={`All files of one dataset at once, up to ${formatBytes(Number(limits.maxBytes))}; or drop them anywhere on the page`}
        onClick={() => input.current?.click()}
      >
        <Icon name="upload" /> Upload data
      </button>
      <input
        ref={input}
        class="upload-input"
        type="file"
        multiple
        hidden
        aria-label="Files to upload"
        onChange={(e) => {
          const { files } = e.currentTarget;
          if (files?.length) port.upload([...files], undefined);
          e.currentTarget.value = ""; // So that the same files can be chosen again.
        }}
      />
    </div>
  );
}
