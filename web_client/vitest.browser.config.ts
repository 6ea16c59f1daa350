import { fileURLToPath } from "node:url";
import { defineConfig } from "vitest/config";

const installed = (name: string) => fileURLToPath(new URL(`node_modules/${name}`, import.meta.url));

/** The tests in ../tests/browser: a real server and a real Chromium, one test after the other. */
export default defineConfig({
  root: fileURLToPath(new URL("..", import.meta.url)),
  cacheDir: installed(".vite-browser"),
  server: { fs: { strict: false } }, // The tests lie outside this folder.
  resolve: {
    alias: {
      "playwright-core": installed("playwright-core"),
      "axe-core": installed("axe-core"),
      fflate: installed("fflate"),
    },
  },
  test: {
    include: ["tests/browser/*.test.ts"],
    environment: "node",
    fileParallelism: false,
    // One process, so that all files share one browser (support/browser.ts) and are loaded into warm modules.
    pool: "forks",
    poolOptions: { forks: { singleFork: true, isolate: false } },
    expect: { poll: { timeout: 20_000 } }, // A page's state is waited for, not looked at once.
    testTimeout: 120_000,
    hookTimeout: 120_000,
  },
});
