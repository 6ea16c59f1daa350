import { Codec } from "../net/gen/volcast/v1/frame_pb";
import type { AppState } from "../state/app_state";
import { formatBytes, formatMs } from "./format";

interface Props {
  readonly state: AppState;
}

function rowsOf(state: AppState): readonly (readonly [name: string, value: string])[] {
  const picture = state.picture.value;
  const latency = state.latency.value;
  if (!picture) return [];
  const stage = (ms: number | undefined): string => (ms === undefined ? "–" : formatMs(ms));
  const t = picture.timings;
  const exact = picture.lossless ? ", lossless" : "";
  return [
    ["Input to drawn, p50", stage(latency?.p50)],
    ["Input to drawn, p95", stage(latency?.p95)],
    ["Wait for the renderer", stage(t?.waitMs)],
    ["Upload", stage(t?.uploadMs)],
    ["Draw", stage(t?.drawMs)],
    ["Read back", stage(t?.readbackMs)],
    ["Encode", stage(t?.encodeMs)],
    ["Queue", stage(t?.queueMs)],
    ["Decode", stage(picture.decodeMs)],
    ["Picture", `${picture.width} × ${picture.height}`],
    ["Codec", `${picture.codec === Codec.PNG ? "PNG" : "JPEG"}${exact}`],
    ["Integrator", picture.integrators.join(", ") || "–"],
  ];
}

/** Frames, latency and bytes in one line; its parts on request. */
export function Readout({ state }: Props) {
  const picture = state.picture.value;
  if (!picture) return null;
  const latency = state.latency.value;
  return (
    <details class="readout">
      <summary title="Pictures per second, input to drawn (median), bytes of the newest picture">
        <span>{Math.round(state.framesPerSecond.value) || "–"} fps</span>
        <span>{latency ? formatMs(latency.p50) : "– ms"}</span>
        <span>{formatBytes(picture.bytes)}</span>
        <span class="spoken">frame rate, input to drawn, bytes a frame</span>
      </summary>
      <dl>
        {rowsOf(state).map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}
