import { fromBinary, toBinary } from "@bufbuild/protobuf";
import { type Scene, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import { editedMapOf } from "../transfer/map_file";
import type { Orbit } from "../view/camera";
import type { Maps } from "./app_state";

/** A view with all that the user did to it: what a reload, or a return to a dataset, restores. */
export interface ViewDocument {
  readonly scene: Scene;
  readonly orbit: Orbit;
  readonly home: Orbit;
  readonly edit: Maps;
}

const kVersion = 1;

/** Text for session storage. */
export function writeDocument(document: ViewDocument): string {
  const bytes = toBinary(SceneSchema, document.scene);
  const scene = btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""));
  return JSON.stringify({ ...document, scene, version: kVersion });
}

const isFinite3 = (v: unknown): boolean =>
  Array.isArray(v) && v.length === 3 && v.every((x) => Number.isFinite(x));

function isOrbit(value: unknown): value is Orbit {
  const o = value as Partial<Orbit> | null;
  return (
    !!o &&
    isFinite3(o.target) &&
    isFinite3(o.axis) &&
    [o.yaw, o.pitch, o.distance, o.fovyDegrees].every((x) => Number.isFinite(x))
  );
}

/** Maps as JSON has them; a layer that draws without a map has none. Errors: what is wrong, and where. */
export function mapsOf(value: unknown): Maps {
  const { map, second } = value as { map?: unknown; second?: unknown };
  const isNone = Array.isArray(map) && map.length === 0;
  const first = isNone
    ? { map: [], density: 1, smooth: undefined, apart: undefined }
    : editedMapOf(value, "editor");
  return {
    ...first,
    second: second === undefined ? undefined : editedMapOf(second, "editor.second"),
  };
}

/** Reads what writeDocument wrote; undefined for anything else. */
export function readDocument(text: string | null): ViewDocument | undefined {
  if (!text) return undefined;
  try {
    const raw = JSON.parse(text) as { version?: number; scene?: string } & Omit<
      ViewDocument,
      "scene"
    >;
    if (raw.version !== kVersion || typeof raw.scene !== "string") return undefined;
    if (!isOrbit(raw.orbit) || !isOrbit(raw.home)) return undefined;
    const bytes = Uint8Array.from(atob(raw.scene), (c) => c.charCodeAt(0));
    const scene = fromBinary(SceneSchema, bytes);
    return { scene, orbit: raw.orbit, home: raw.home, edit: mapsOf(raw.edit) };
  } catch {
    return undefined;
  }
}
