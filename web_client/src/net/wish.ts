import type { Maps } from "../state/app_state";
import type { ViewDocument } from "../state/document";
import type { Scene } from "./gen/volcast/v1/scene_pb";

/** What a view is to show; an empty `dataset` is the server's first. */
export interface Wish {
  readonly dataset: string;
  readonly document: ViewDocument | undefined;
  /** The document is what is shown already; edits made since it was sent are newer. */
  readonly shown: boolean;
  /** Joins a view that is there. */
  readonly link?: string | undefined;
  /** Whoever is in the view that is left does not go along. */
  readonly alone?: boolean | undefined;
  /** As it was saved; instead of a document. */
  readonly scene?: Scene | undefined;
  /** How the maps of that scene were edited. */
  readonly edit?: Maps | undefined;
}

export const kAnything: Wish = { dataset: "", document: undefined, shown: false };

export const wishToJoin = (link: string): Wish => ({ ...kAnything, link });

export const wishForScene = (scene: Scene, edit?: Maps): Wish => ({
  ...kAnything,
  dataset: scene.layers[0]?.dataset ?? "",
  scene,
  edit,
});

const datasetOf = (document: ViewDocument): string => document.scene.layers[0]?.dataset ?? "";

export const wishFor = (document: ViewDocument): Wish => ({
  ...kAnything,
  dataset: datasetOf(document),
  document,
});

/** To go on with what is shown, if anything is. */
export const wishToStay = (document: ViewDocument | undefined): Wish =>
  document ? { ...wishFor(document), shown: true } : kAnything;
