import { type Signal, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { AppState } from "../state/app_state";
import { CopyField } from "./copy_field";
import { Dialog } from "./dialog";
import { PeopleList } from "./people_list";
import type { AppPort } from "./port";
import { ShareLinks } from "./share_links";
import "./style/share.css";

interface Props {
  readonly state: AppState;
  readonly port: AppPort;
  readonly open: Signal<boolean>;
}

/** What is shown, to open again: by an address that says all of it, or as a file. */
function Snapshot({ port }: Pick<Props, "port">) {
  const url = useSignal("");
  const file = useRef<HTMLInputElement>(null);
  useEffect(() => {
    void port.url().then((text) => {
      url.value = text;
    });
  }, []);
  return (
    <section aria-labelledby="snapshot-heading">
      <h3 id="snapshot-heading">What is shown now</h3>
      <CopyField label="Address of this picture" text={url.value} />
      <div class="person-actions">
        <button type="button" class="text-button" onClick={port.saveScene}>
          Save the scene
        </button>
        <button type="button" class="text-button" onClick={() => file.current?.click()}>
          Load a scene
        </button>
        <input
          ref={file}
          type="file"
          hidden
          accept="application/json,.json"
          aria-label="Scene file"
          onChange={(e) => {
            const chosen = e.currentTarget.files?.[0];
            if (chosen) port.loadScene(chosen);
            e.currentTarget.value = "";
          }}
        />
      </div>
    </section>
  );
}

/** Everything about others: who is here, how more come, and how to pass on what is shown. */
export function ShareDialog({ state, port, open }: Props) {
  const close = (): void => {
    open.value = false;
  };
  return (
    <Dialog id="share-heading" heading="Share" look="share" close={close}>
      <PeopleList state={state} port={port} />
      <ShareLinks state={state} port={port} />
      <Snapshot port={port} />
    </Dialog>
  );
}
