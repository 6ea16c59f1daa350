import { fromJsonString, toJsonString } from "@bufbuild/protobuf";
import { type Scene, SceneSchema } from "../net/gen/volcast/v1/scene_pb";

/** A scene as the server, its commands and scripts read it: protobuf's JSON, with a last newline. */
export const writeScene = (scene: Scene): string =>
  `${toJsonString(SceneSchema, scene, { prettySpaces: 2 })}\n`;

/** Throws Error with a sentence that names what is wrong. What else a scene may be the server knows. */
export function readScene(text: string): Scene {
  const scene = fromJsonString(SceneSchema, text);
  if (scene.layers.length === 0) throw new Error("it has no layers");
  if (!scene.camera) throw new Error("it has no camera");
  return scene;
}
