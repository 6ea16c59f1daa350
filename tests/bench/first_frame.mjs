// Time from `deploy/run` in a clean clone to the first picture in a real Chromium.
//
// usage: node tests/bench/first_frame.mjs [DATA_DIR] [--cold]
//
// Clones this repository into a temporary folder, runs its deploy/run on a free port, opens the page
// as soon as the server is ready, and prints seconds. --cold: without the compiler cache. Packages
// that are installed stay installed; a fresh Debian adds their installation.
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const repo = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const cold = process.argv.includes("--cold");
const data = process.argv.slice(2).find((word) => !word.startsWith("--"));
const folder = mkdtempSync(join(tmpdir(), "volcast-first-frame-"));
const clone = join(folder, "volcast");
const seconds = (since) => ((performance.now() - since) / 1000).toFixed(1);

/** Runs deploy/run and resolves with the page's address. */
function started(child) {
  return new Promise((done, failed) => {
    createInterface({ input: child.stdout }).on("line", (line) => {
      const ready = /^Volcast is ready: (\S+)/.exec(line);
      if (ready) done(ready[1]);
      else if (/^(==>|    done)/.test(line)) console.log(line);
    });
    child.on("exit", (code) => failed(new Error(`deploy/run ended with ${code}`)));
  });
}

execFileSync("git", ["clone", "--quiet", repo, clone]);
const begun = performance.now();
const child = spawn(
  join(clone, "deploy/run"),
  [...(data ? [resolve(data)] : []), "--port", "0"],
  {
    stdio: ["ignore", "pipe", "inherit"],
    env: { ...process.env, ...(cold ? { CCACHE_DISABLE: "1" } : {}) },
  },
);
try {
  const url = await started(child);
  console.log(`ready after ${seconds(begun)} s`);
  const { chromium } = createRequire(join(clone, "web_client/package.json"))("playwright-core");
  const opened = performance.now();
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM_BIN ?? "/usr/bin/chromium",
    args: process.getuid?.() === 0 ? ["--no-sandbox"] : [],
  });
  const page = await browser.newPage();
  await page.goto(url);
  await page.waitForSelector(".picture[data-sequence]", { timeout: 120_000 });
  console.log(`first picture ${seconds(opened)} s after the browser was started`);
  console.log(`deploy/run to the first picture: ${seconds(begun)} s`);
  await browser.close();
} finally {
  child.removeAllListeners("exit");
  child.kill("SIGTERM");
  rmSync(folder, { recursive: true, force: true });
}
