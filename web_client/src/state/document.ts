import { fromBinary, toBinary } from "@bufbuild/protobuf";
import { type Scene, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import type { Orbit } from "../view/camera";
import type { MapEdit, Maps } from "./app_state";

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

const isMap = (value: unknown): value is MapEdit => {
  const m = value as Partial<MapEdit> | null | undefined;
  const { apart } = m ?? {};
  const parts = !apart || (Array.isArray(apart.colours) && Array.isArray(apart.opacities));
  return !!m && Array.isArray(m.map) && Number.isFinite(m.density) && parts;
};

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
    const { map, density, smooth, apart, second } = raw.edit;
    if (!isMap(raw.edit) || !(second === undefined || isMap(second))) return undefined;
    const bytes = Uint8Array.from(atob(raw.scene), (c) => c.charCodeAt(0));
    const scene = fromBinary(SceneSchema, bytes);
    const edit = { map, density, smooth, apart, second };
    return { scene, orbit: raw.orbit, home: raw.home, edit };
  } catch {
    return undefined;
  }
}
