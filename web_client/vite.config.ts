import { defineConfig } from "vitest/config";

/** `npm run build` leaves what `volcast serve` hands to browsers in build/web_client. */
export default defineConfig({
  build: {
    outDir: "../build/web_client",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
  },
  worker: { format: "es" },
  test: { include: ["src/**/*.test.ts"], environment: "node" },
});
