// Tests of the page's pure parts: bundles tests/page/unit/*.test.ts with the page's own builder and runs them under
// node's test runner, which cannot read TypeScript in node 18.
import { spawnSync } from "node:child_process";
import { mkdirSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.resolve(here, "../..");
const require = createRequire(path.join(root, "viewer/page/node_modules/vite/package.json"));
const esbuild = require("esbuild");
const out = path.join(root, "build/page-test/unit");
mkdirSync(out, { recursive: true });
const entries = readdirSync(path.join(here, "unit")).filter((f) => f.endsWith(".test.ts")).map((f) => path.join(here, "unit", f));
esbuild.buildSync({ entryPoints: entries, outdir: out, bundle: true, platform: "node", format: "esm", outExtension: { ".js": ".mjs" }, logLevel: "warning" });
const files = entries.map((f) => path.join(out, path.basename(f).replace(/\.ts$/, ".mjs")));
const ran = spawnSync(process.execPath, ["--test", "--test-reporter=tap", ...files], { encoding: "utf8" });
const count = (what) => Number(new RegExp(`^# ${what} (\\d+)`, "m").exec(ran.stdout)?.[1] ?? 0);
if (ran.status !== 0) process.stdout.write(ran.stdout + ran.stderr);
console.log(`${count("pass")} passed, ${count("fail")} failed`);
process.exit(ran.status ?? 1);
