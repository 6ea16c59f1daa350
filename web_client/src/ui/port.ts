import type { Role } from "../net/gen/volcast/v1/session_pb";
import type { MeasureAim } from "../state/accuracy";
import type { TurnWish } from "../state/recording";
import type { ViewOption } from "../state/view_options";

/** What the panels ask of one view, beyond changing its signals. */
export interface ViewPort {
  openDataset(id: string): void;
  drawAgain(): void;
  screenshot(): void;
  recordTurn(wish: TurnWish): void;
  toggleProjection(): void;
  resetCamera(): void;
  explain(): void;
  /** Begins to measure; nothing else is measured then. */
  measure(aim: MeasureAim): void;
  stopMeasuring(): void;
  /** Shows the picture's difference from the reference, or shows it no more. */
  compare(on: boolean): void;
  undo(): void;
  redo(): void;
  takeControl(): void;
  handOver(person: number): void;
  askControl(withdraw: boolean): void;
  /** `expiresS`: from now; 0: a day. */
  share(role: Role, expiresS: number): void;
  saveScene(): void;
  loadScene(file: File): void;
  /** Goes on with a copy of the view, alone. */
  leave(): void;
}

/** What the panels ask of the page. */
export interface PagePort {
  importAgain(id: string): void;
  reconnect(): void;
  toggle(option: ViewOption): void;
  toggleFullscreen(): void;
  /** The name that others see; empty: the server chooses one. */
  rename(person: string): void;
  /** A copy of the active view beside it. */
  addView(): void;
  closeView(key: number): void;
  activate(key: number): void;
  linkCameras(on: boolean): void;
  /** The address of what the page shows now, in full. */
  url(): Promise<string>;
}

/** What the panels ask of the rest of the client: of the view that they are about, and of the page. */
export type AppPort = ViewPort & PagePort;
