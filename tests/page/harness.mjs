// What the page's tests share: a program that serves, a browser that draws in software, named tests, screenshots.
import { spawn } from "node:child_process";
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
export const program = path.resolve(root, process.env.CLEANCOLOR ?? "build/release/cli/cleancolor");
export const out = path.join(root, "build/page-test");
mkdirSync(out, { recursive: true });
const require = createRequire(path.join(root, "viewer/page/package.json"));
const { chromium } = require("playwright-core");
export const axe_source = require.resolve("axe-core/axe.min.js");

let passed = 0, failed = 0;
export async function test(name, body) {
  const start = Date.now();
  try {
    await body();
    passed++;
    console.log(`ok    ${name} (${Date.now() - start} ms)`);
  } catch (e) {
    failed++;
    console.log(`FAIL  ${name}\n      ${String(e.stack ?? e).split("\n").slice(0, 6).join("\n      ")}`);
  }
}
export function summary() { console.log(`${passed} passed, ${failed} failed`); return failed === 0; }

/** Starts `cleancolor view` and resolves with its address and how to end it. */
export function serve(files) {
  const child = spawn(program, ["view", "--no-browser", "--port", "0", ...files], { cwd: out });
  return new Promise((resolve, reject) => {
    let said = "";
    const hear = (text) => {
      said += text;
      const address = /http:\/\/127\.0\.0\.1:\d+\/\?token=\S+/.exec(said);
      if (address) resolve({ address: address[0], end: () => child.kill() });
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("error", reject);
    child.on("exit", (code) => reject(new Error(`${program} view ended with ${code}: ${said}`)));
  });
}

export const browser = () => chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});

/** A page at an address, audited and drawn in full; `troubles` gathers what the console complains of; `before` prepares the page. */
export async function open_page(chrome, address, options = {}, before = async () => {}) {
  const context = await chrome.newContext({ viewport: { width: 1280, height: 720 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  page.troubles = [];
  page.on("console", (m) => { if (m.type() === "error" || /content security/i.test(m.text())) page.troubles.push(m.text()); });
  page.on("pageerror", (e) => page.troubles.push(String(e)));
  await before(page);
  await page.goto(address);
  return page;
}
export const audited = (page) => page.waitForFunction(() => window.cleancolor?.viewer.sides.length > 0 && window.cleancolor.viewer.sides.every((s) => s.audit), null, { timeout: 40000 });
export const finished = (page) => page.waitForFunction(() => window.cleancolor.counts().every((c) => c.finished), null, { timeout: 60000 });
export const settled = (page) => page.evaluate(() => window.cleancolor.settled());
export async function picture(page, name) { await settled(page); await page.screenshot({ path: path.join(out, `${name}.png`) }); }
export const at = (page) => page.evaluate(() => { const v = window.cleancolor.viewer; return { ...v.at, from: v.from_layer, layers: v.first.moves.layer_z.length }; });
