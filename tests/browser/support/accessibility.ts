import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import type { Client } from "./client";

const require = createRequire(new URL("../../../web_client/package.json", import.meta.url));
const kAxe = readFileSync(require.resolve("axe-core"), "utf8");

/** Rules that axe finds broken, with the first element of each. */
export async function violations(client: Client): Promise<string[]> {
  await client.page.evaluate(kAxe);
  return client.page.evaluate(async () => {
    interface Axe {
      run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }>;
    }
    const { axe } = window as unknown as { axe: Axe };
    const result = await axe.run();
    return result.violations.map((v) => `${v.id}: ${v.nodes[0]?.html}`);
  });
}
