import type { MeasureAim } from "../state/accuracy";
import type { TurnWish } from "../state/recording";
import type { ViewOption } from "../state/view_options";

/** What the panels ask of the rest of the client, beyond changing signals. */
export interface AppPort {
  openDataset(id: string): void;
  importAgain(id: string): void;
  drawAgain(): void;
  reconnect(): void;
  screenshot(): void;
  recordTurn(wish: TurnWish): void;
  toggleProjection(): void;
  resetCamera(): void;
  toggle(option: ViewOption): void;
  toggleFullscreen(): void;
  explain(): void;
  /** Begins to measure; nothing else is measured then. */
  measure(aim: MeasureAim): void;
  stopMeasuring(): void;
  /** Shows the picture's difference from the reference, or shows it no more. */
  compare(on: boolean): void;
}
