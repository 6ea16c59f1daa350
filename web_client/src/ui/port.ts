import type { TurnWish } from "../state/recording";
import type { ViewOption } from "../state/view_options";

/** What the panels ask of the rest of the client, beyond changing signals. */
export interface AppPort {
  openDataset(id: string): void;
  importAgain(id: string): void;
  drawThumbnail(id: string): void;
  /** `folder`: that the files were in. */
  upload(files: readonly File[], folder: string | undefined): void;
  drawAgain(): void;
  reconnect(): void;
  screenshot(): void;
  recordTurn(wish: TurnWish): void;
  toggleProjection(): void;
  resetCamera(): void;
  toggle(option: ViewOption): void;
  toggleFullscreen(): void;
  explain(): void;
  measureAccuracy(): void;
  stopMeasuring(): void;
}
