import type { DatasetInfo, FieldInfo, ImportLog } from "../net/gen/volcast/v1/session_pb";
import { Association, DatasetKind } from "../net/gen/volcast/v1/session_pb";
import { usualRangeOf } from "../state/actions";
import { formatBytes, formatCount, formatMs, formatNumber } from "./format";
import { barHeights } from "./map_plot";

type Row = readonly [name: string, text: string];

/** Names and values, those without a value left out. */
function Rows({ rows }: { readonly rows: readonly (Row | undefined | false)[] }) {
  return (
    <dl class="facts">
      {rows.map(
        (row) =>
          row && (
            <div key={row[0]}>
              <dt>{row[0]}</dt>
              <dd>{row[1]}</dd>
            </div>
          ),
      )}
    </dl>
  );
}

const kPlaces: Readonly<Record<Association, string>> = {
  [Association.VERTEX]: "vertex",
  [Association.CELL]: "cell",
  [Association.CELL_VERTEX]: "cell vertex",
};

/** Counts as bars, by their logarithm. */
function Histogram({ field }: { readonly field: FieldInfo }) {
  const heights = barHeights(field.histogram);
  const { min, max } = usualRangeOf(field);
  const path = heights.map((h, i) => `M${i} 40V${40 - 40 * h}h1V40`).join("");
  const label = `Histogram of ${field.name} from ${formatNumber(min)} to ${formatNumber(max)}, counts on a logarithmic scale`;
  return (
    <svg
      class="histogram"
      viewBox={`0 0 ${heights.length} 40`}
      preserveAspectRatio="none"
      role="img"
      aria-label={label}
    >
      <path d={path} />
    </svg>
  );
}

function Field({ field, kind }: { readonly field: FieldInfo; readonly kind: DatasetKind }) {
  const unit = field.unit && ` ${field.unit}`;
  const what = kind === DatasetKind.MESH ? "cells" : "voxels";
  const number = (x: number): string => `${formatNumber(x, 6)}${unit}`;
  return (
    <section class="field-facts">
      <h3>{field.name}</h3>
      {field.histogram.length > 0 && <Histogram field={field} />}
      <Rows
        rows={[
          ["Smallest", number(field.min)],
          ["Largest", number(field.max)],
          field.mean !== undefined && ["Mean", number(field.mean)],
          field.deviation !== undefined && ["Standard deviation", number(field.deviation)],
          field.values > 0n && ["Values", formatCount(Number(field.values))],
          ["Without value (NaN)", `${formatCount(Number(field.withoutValue))} ${what}`],
          kind === DatasetKind.MESH && ["One value a", kPlaces[field.association]],
          field.steps > 1 && ["Time steps", String(field.steps)],
        ]}
      />
    </section>
  );
}

function droppedOf(log: ImportLog): Row[] {
  const counts: readonly (readonly [string, bigint])[] = [
    ["Cells without volume, left out", log.cellsWithoutVolume],
    ["Cells inside out, turned round", log.cellsInverted],
    ["Cells doubled, left out", log.cellsDoubled],
    ["Faces between more than two cells", log.facesNotManifold],
  ];
  return counts
    .filter(([, count]) => count > 0n)
    .map(([name, count]) => [name, formatCount(Number(count))]);
}

/** How the data was read. */
function Log({ info, log }: { readonly info: DatasetInfo; readonly log: ImportLog }) {
  const read = new Date(1000 * Number(log.finished));
  return (
    <section class="field-facts">
      <h3>Import</h3>
      <Rows
        rows={[
          ["Format", log.format],
          ["Read", read.toLocaleString()],
          ["Took", formatMs(log.ms)],
          log.peakMb > 0 && ["Memory at most", formatBytes(log.peakMb * 2 ** 20)],
          ["Version", String(info.version)],
          log.boundaryFaces > 0n && ["Boundary faces", formatCount(Number(log.boundaryFaces))],
          log.coarserLevels > 0 && ["Coarser levels", String(log.coarserLevels)],
          ...droppedOf(log),
        ]}
      />
      {info.warnings.length > 0 && (
        <ul class="remarks">
          {info.warnings.map((warning) => (
            <li key={warning}>{warning}</li>
          ))}
        </ul>
      )}
    </section>
  );
}

const triple = (v: { x: number; y: number; z: number } | undefined): string =>
  v ? [v.x, v.y, v.z].map((c) => formatNumber(c, 5)).join(", ") : "";

/** All that is known of a dataset: its size, the statistics of its fields, how it was read. */
export function DataDetails({ info }: { readonly info: DatasetInfo }) {
  const isMesh = info.kind === DatasetKind.MESH;
  return (
    <div class="data-details">
      <Rows
        rows={[
          isMesh && ["Cells", formatCount(Number(info.cells))],
          isMesh && ["Vertices", formatCount(Number(info.vertices))],
          !isMesh && ["Voxels", info.voxels.join(" × ")],
          !isMesh && info.spacing !== undefined && ["Spacing", triple(info.spacing)],
          !isMesh && info.voxelType !== "" && ["Type", info.voxelType],
          ["From", triple(info.boundsMin)],
          ["To", triple(info.boundsMax)],
          ["Size as drawn", formatBytes(Number(info.bytes))],
        ]}
      />
      {info.fields.map((field) => (
        <Field key={field.name} field={field} kind={info.kind} />
      ))}
      {info.log && <Log info={info} log={info.log} />}
    </div>
  );
}
