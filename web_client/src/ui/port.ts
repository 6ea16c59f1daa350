/** What the panels ask of the rest of the client, beyond changing signals. */
export interface AppPort {
  openDataset(id: string): void;
  importAgain(id: string): void;
  drawAgain(): void;
  reconnect(): void;
  screenshot(): void;
  toggleProjection(): void;
  resetCamera(): void;
  toggleFullscreen(): void;
  explain(): void;
  measureAccuracy(): void;
  stopMeasuring(): void;
}
