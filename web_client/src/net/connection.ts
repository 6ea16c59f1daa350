import { waitMs } from "./backoff";

/** What a connection tells its owner. Called on the page's thread, never from within `send`. */
export interface ConnectionEvents {
  opened(): void;
  received(message: Uint8Array<ArrayBuffer>): void;
  /** Lost, or never opened; the next attempt is at `retryAt` on performance.now()'s clock. */
  lost(retryAt: number, reason: string): void;
  retrying(): void;
}

/** Longest silence in ms, server pings included, before a connection counts as lost. */
const kSilenceMs = 12_000;
const kOpenTimeoutMs = 10_000;
const kSubprotocol = "volcast.v1";

/** One WebSocket after the other to the same address: lost ones are replaced, ever more slowly. */
export class Connection {
  readonly #url: string;
  readonly #events: ConnectionEvents;
  #socket: WebSocket | undefined;
  #attempt = 0;
  #retryTimer = 0;
  #openTimer = 0;
  #heardAt = 0;

  constructor(url: string, events: ConnectionEvents) {
    this.#url = url;
    this.#events = events;
  }

  /** Starts, or cuts the waiting short. Nothing happens where a socket is open or opening. */
  connect(): void {
    if (this.#socket) return;
    clearTimeout(this.#retryTimer);
    this.#events.retrying();
    const socket = new WebSocket(this.#url, kSubprotocol);
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    this.#openTimer = window.setTimeout(
      () => this.#lose(socket, "no answer in 10 s"),
      kOpenTimeoutMs,
    );
    socket.onopen = () => {
      clearTimeout(this.#openTimer);
      this.#heardAt = performance.now();
      this.#events.opened();
    };
    socket.onmessage = (event: MessageEvent<unknown>) => {
      if (socket !== this.#socket || !(event.data instanceof ArrayBuffer)) return;
      this.#heardAt = performance.now();
      this.#events.received(new Uint8Array(event.data));
    };
    socket.onclose = (event) => this.#lose(socket, event.reason || `closed (${event.code})`);
  }

  /** The greeting was answered: the next loss starts waiting from the shortest time again. */
  settled(): void {
    this.#attempt = 0;
  }

  /** False where the message was not handed to an open socket. */
  send(message: Uint8Array<ArrayBuffer>): boolean {
    if (this.#socket?.readyState !== WebSocket.OPEN) return false;
    this.#socket.send(message);
    return true;
  }

  /** Gives up a socket that has been silent for too long; call it now and then. */
  checkSilence(): void {
    const socket = this.#socket;
    if (socket?.readyState !== WebSocket.OPEN) return;
    if (performance.now() - this.#heardAt > kSilenceMs) this.#lose(socket, "silent for 12 s");
  }

  #lose(socket: WebSocket, reason: string): void {
    if (socket !== this.#socket) return;
    clearTimeout(this.#openTimer);
    this.#socket = undefined;
    socket.onclose = null;
    socket.onmessage = null;
    socket.close();
    const wait = waitMs(this.#attempt, Math.random());
    this.#attempt += 1;
    this.#retryTimer = window.setTimeout(() => this.connect(), wait);
    this.#events.lost(performance.now() + wait, reason);
  }
}
