import { type ChildProcess, spawn } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const kRoot = fileURLToPath(new URL("../../..", import.meta.url));
const kStartMs = 60_000;

/** The program under test: VOLCAST_BIN, else the newest build/<preset>/bin/volcast. */
export function findProgram(): string {
  const given = process.env.VOLCAST_BIN;
  if (given) return given;
  const build = join(kRoot, "build");
  const found = (existsSync(build) ? readdirSync(build) : [])
    .map((preset) => join(build, preset, "bin", "volcast"))
    .filter((path) => existsSync(path))
    .sort((a, b) => statSync(b).mtimeMs - statSync(a).mtimeMs);
  if (!found[0]) throw new Error("no build/*/bin/volcast: build the server or set VOLCAST_BIN");
  return found[0];
}

/** Where pictures for people go, made if need be. */
export function screenshotFolder(): string {
  const folder = join(kRoot, "build", "screenshots");
  mkdirSync(folder, { recursive: true });
  return folder;
}

function childrenOf(pid: number): number[] {
  const path = `/proc/${pid}/task`;
  if (!existsSync(path)) return [];
  return readdirSync(path).flatMap((task) => {
    const text = readFileSync(`${path}/${task}/children`, "utf8").trim();
    return text ? text.split(" ").map(Number) : [];
  });
}

/** A real `volcast serve`, ended with the test. */
export class Server {
  readonly url: string;
  readonly port: number;
  readonly #process: ChildProcess;
  readonly #folder: string;
  #said = "";

  private constructor(process: ChildProcess, folder: string, url: string) {
    this.#process = process;
    const listen = (text: Buffer): void => {
      this.#said += text.toString();
    };
    process.stdout?.on("data", listen);
    process.stderr?.on("data", listen);
    this.#folder = folder;
    this.url = url;
    this.port = Number(new URL(url).port);
  }

  /** Serves `data`, or the built-in demo; port 0 lets the system choose. */
  static async start(
    options: { data?: string; port?: number; more?: readonly string[] } = {},
  ): Promise<Server> {
    const folder = mkdtempSync(join(tmpdir(), "volcast-browser-"));
    const args = ["serve", "--port", String(options.port ?? 0), ...(options.more ?? [])];
    if (options.data) args.push(options.data);
    const child = spawn(findProgram(), args, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
    let said = "";
    const url = await new Promise<string>((resolve, reject) => {
      const fail = (why: string): void => reject(new Error(`${why}; it said:\n${said}`));
      const timer = setTimeout(() => fail("the server named no address in 60 s"), kStartMs);
      const read = (text: Buffer): void => {
        said += text.toString();
        const match = /http:\/\/[\w.:[\]]+:(\d+)/.exec(said);
        if (!match || match[1] === "0") return;
        clearTimeout(timer);
        resolve(`${match[0]}/`);
      };
      child.stdout?.on("data", read);
      child.stderr?.on("data", read);
      child.once("error", (error) => fail(String(error)));
      child.once("exit", (code) => fail(`the server ended with ${code}`));
    });
    const server = new Server(child, folder, url);
    const page = await (await fetch(url)).text();
    if (page.includes('id="app"')) return server;
    await server.stop();
    throw new Error("the server has no web client to hand out: npm run build in web_client");
  }

  /** What the log says of answers to colour patches, a line each. */
  patches(): string[] {
    return this.#said.split("\n").filter((line) => line.includes("event=patch "));
  }

  /** Process ids of its GL workers, the spare one included. */
  workers(): number[] {
    const name = (pid: number): string => {
      try {
        return readFileSync(`/proc/${pid}/cmdline`, "utf8").split("\0")[0] ?? "";
      } catch {
        return ""; // It ended between the two looks.
      }
    };
    return childrenOf(this.#process.pid ?? 0).filter((pid) => name(pid).endsWith("volcast-worker"));
  }

  async stop(signal: NodeJS.Signals = "SIGTERM"): Promise<void> {
    if (this.#process.exitCode === null && this.#process.signalCode === null) {
      const ended = new Promise((resolve) => this.#process.once("exit", resolve));
      this.#process.kill(signal);
      const timer = setTimeout(() => this.#process.kill("SIGKILL"), 10_000);
      await ended;
      clearTimeout(timer);
    }
    rmSync(this.#folder, { recursive: true, force: true });
  }
}
