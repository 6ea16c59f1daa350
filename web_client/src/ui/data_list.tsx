import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { type DatasetInfo, DatasetKind, DatasetState } from "../net/gen/volcast/v1/session_pb";
import type { AppState } from "../state/app_state";
import { formatBytes, formatCount } from "./format";
import { Icon } from "./icons";
import { lazy } from "./lazy";
import type { AppPort } from "./port";
import { UploadPanel } from "./upload_panel";

const DataDetails = lazy(async () => (await import("./data_details")).DataDetails);

function describe(info: DatasetInfo): string {
  const size = info.bytes > 0n ? formatBytes(Number(info.bytes)) : "";
  const parts: string[] = [];
  if (info.kind === DatasetKind.MESH) {
    parts.push(`Mesh, ${formatCount(Number(info.cells))} cells`);
  } else if (info.kind === DatasetKind.VOLUME) {
    parts.push(`Volume, ${info.voxels.join(" × ")}`);
  }
  if (size) parts.push(size);
  return parts.join(" · ");
}

function Progress({ info }: { readonly info: DatasetInfo }) {
  const percent = Math.round(100 * info.progress);
  return (
    <div class="dataset-progress">
      <progress max={100} value={percent} aria-label={`Importing ${info.name}`} />
      <span>
        {info.stage || "importing"}, {percent} %
      </span>
    </div>
  );
}

/** A small picture of the data; asked of the server once the row is in sight. */
function Thumbnail({ info, port }: { readonly info: DatasetInfo; readonly port: AppPort }) {
  const place = useRef<HTMLSpanElement>(null);
  const address = useSignal("");
  const { id, version, state, thumbnail } = info;
  const isReady = state === DatasetState.READY;
  useEffect(() => {
    if (thumbnail.length === 0) {
      address.value = "";
      return undefined;
    }
    const jpeg = new Blob([thumbnail as Uint8Array<ArrayBuffer>], { type: "image/jpeg" });
    address.value = URL.createObjectURL(jpeg);
    return () => URL.revokeObjectURL(address.value);
  }, [thumbnail]);
  useEffect(() => {
    if (!place.current || !isReady || thumbnail.length > 0) return undefined;
    const observer = new IntersectionObserver(([entry]) => {
      if (!entry?.isIntersecting) return;
      port.drawDatasetThumbnail(id);
      observer.disconnect();
    });
    observer.observe(place.current);
    return () => observer.disconnect();
  }, [id, version, isReady, thumbnail.length > 0]);
  return (
    <span ref={place} class="thumbnail">
      {address.value && <img src={address.value} alt="" width={64} height={48} />}
    </span>
  );
}

/** Statistics and the import's log, fetched when they are opened. */
function Details({ info }: { readonly info: DatasetInfo }) {
  const open = useSignal(false);
  const remarks = info.warnings.length;
  return (
    <details
      class="dataset-more"
      onToggle={(e) => {
        open.value = e.currentTarget.open;
      }}
    >
      <summary>
        Details<span class="unseen"> of {info.name || info.id}</span>
        {remarks > 0 && ` and ${remarks === 1 ? "1 remark" : `${remarks} remarks`}`}
      </summary>
      {open.value && <DataDetails info={info} />}
    </details>
  );
}

interface RowProps {
  readonly info: DatasetInfo;
  readonly shown: boolean;
  readonly pending: boolean;
  readonly port: AppPort;
}

function Row({ info, shown, pending, port }: RowProps) {
  const row = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (shown) row.current?.scrollIntoView({ block: "nearest" });
  }, [shown]);
  const failed = info.state === DatasetState.FAILED;
  const opening = pending && info.state !== DatasetState.IMPORTING && !failed;
  const note = opening ? "Opening" : describe(info);
  const choose = (): void => (shown ? undefined : port.openDataset(info.id));
  return (
    <li ref={row} class="dataset" data-shown={shown ? "" : undefined} data-dataset={info.id}>
      <button type="button" class="dataset-choose" aria-pressed={shown} onClick={choose}>
        <Thumbnail info={info} port={port} />
        <span class="dataset-text">
          <span class="dataset-name">{info.name || info.id}</span>
          {note && <span class="dataset-note">{note}</span>}
        </span>
      </button>
      {info.state === DatasetState.IMPORTING && <Progress info={info} />}
      {failed && (
        <p class="dataset-error">
          <Icon name="warning" /> <span>{info.error || "The import failed."}</span>
          <button type="button" class="text-button" onClick={() => port.importAgain(info.id)}>
            Import again
          </button>
        </p>
      )}
      {info.state === DatasetState.READY && <Details info={info} />}
    </li>
  );
}

/** What the server offers, with the state of each; one is shown. */
export function DataList({ state, port }: { readonly state: AppState; readonly port: AppPort }) {
  const datasets = state.datasets.value;
  const shown = state.dataset.value?.id;
  const pending = state.pendingDataset.value;
  return (
    <section class="section" aria-labelledby="data-heading">
      <h2 id="data-heading">Data</h2>
      {datasets.length === 0 && (
        <p class="hint">
          {state.connection.value.kind === "open"
            ? "The server's folder holds nothing that it can read."
            : "The list comes with the connection."}
        </p>
      )}
      <ul class="datasets">
        {datasets.map((info) => (
          <Row
            key={info.id}
            info={info}
            shown={info.id === shown}
            pending={info.id === pending}
            port={port}
          />
        ))}
      </ul>
      <UploadPanel state={state} port={port} />
    </section>
  );
}
