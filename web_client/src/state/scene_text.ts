import { fromJson, type JsonObject, type JsonValue, toJson } from "@bufbuild/protobuf";
import { type Scene, SceneSchema } from "../net/gen/volcast/v1/scene_pb";
import type { Maps } from "./app_state";
import { mapsOf } from "./document";

/** A scene with what the editor knows of its maps besides, where that was kept. */
export interface SavedScene {
  readonly scene: Scene;
  readonly edit: Maps | undefined;
}

/**
 * A scene as the server, its commands and scripts read it: protobuf's JSON, with a last newline.
 * They pass over "editor": how the maps of its first layer were edited.
 */
export function writeScene(scene: Scene, editor: Maps): string {
  const json = { ...(toJson(SceneSchema, scene) as JsonObject), editor };
  return `${JSON.stringify(json, null, 2)}\n`;
}

/** Throws Error with a sentence that names what is wrong. What else a scene may be the server knows. */
export function readScene(text: string): SavedScene {
  const json = JSON.parse(text) as JsonValue;
  const isObject = typeof json === "object" && json !== null && !Array.isArray(json);
  const { editor, ...rest } = isObject ? json : { editor: undefined };
  const scene = fromJson(SceneSchema, isObject ? rest : json);
  if (scene.layers.length === 0) throw new Error("it has no layers");
  if (!scene.camera) throw new Error("it has no camera");
  return { scene, edit: editor === undefined ? undefined : mapsOf(editor) };
}
