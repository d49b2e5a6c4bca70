// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the tests and hands them to node's runner: node tests/run.mjs [DIRECTORY WITH PAGES].
// With a directory, what `pages.mjs` wrote there is held against the schema, too.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { build } from "esbuild";

const folder = new URL(".", import.meta.url).pathname;
const output = mkdtempSync(join(tmpdir(), "gnomon-page-"));
try {
  await build({
    entryPoints: readdirSync(folder)
      .filter((name) => name.endsWith(".test.ts"))
      .map((name) => join(folder, name)),
    bundle: true,
    platform: "node",
    target: "node18",
    format: "cjs",
    outExtension: { ".js": ".cjs" },
    outdir: output,
    logLevel: "warning",
  });
  const files = readdirSync(output).map((name) => join(output, name));
  const done = spawnSync(process.execPath, ["--test", ...files], { stdio: "inherit" });
  process.exitCode = done.status ?? 1;
} finally {
  rmSync(output, { recursive: true });
}
