// All tests of the page, against the real program; started by scripts/page-test.
import { execFileSync } from "node:child_process";
import { existsSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";
import { plate, two_blocks, vase } from "./gcode.mjs";
import { dense, plate_roads } from "./dense.mjs";
import { browser, out, program, root, serve, summary } from "./harness.mjs";
import { known_picture } from "./known_picture.mjs";
import { opening } from "./opening.mjs";
import { report } from "./report.mjs";
import { slicing } from "./slicing.mjs";
import { first_picture, two_million } from "./speed.mjs";
import { troubled } from "./troubled.mjs";
import { viewing } from "./viewing.mjs";

const model = (name) => path.join(root, "models", name);
const file = (name) => path.join(out, name);
const written_by_hand = path.join(root, "tests/page/gcode.mjs");

/** Makes a file that is not there, or older than what it comes from. */
function made(name, sources, make) {
  const made_ms = existsSync(file(name)) ? statSync(file(name)).mtimeMs : 0;
  if (sources.some((s) => statSync(s).mtimeMs > made_ms)) make(file(name));
}
const written = (name, text) => made(name, [written_by_hand], (to) => writeFileSync(to, text()));
for (const [name, protect] of [["protected.gcode", "full"], ["bare.gcode", "none"]]) {
  const meshes = ["two-color-world-50mm_ocean.stl", "two-color-world-50mm_land.stl"].map(model);
  made(name, [program, ...meshes], (to) => execFileSync(program, ["slice", ...meshes, "--printer", "replicator-dual", "--protect", protect, "--quiet", "-o", to], { stdio: "inherit" }));
}
written("blocks.gcode", two_blocks);
written("ten-megabytes.gcode", () => vase(330000));
written("two-million.gcode", () => vase(2000000));
written("plate.gcode", () => plate(plate_roads));
writeFileSync(file("bad.gcode"), "; a file without a move\n");

const chrome = await browser();
const only = process.argv[2];
const groups = [
  ["viewing", [file("protected.gcode"), file("bare.gcode")], viewing], ["troubled", [file("blocks.gcode"), file("bad.gcode")], troubled],
  ["known", [file("blocks.gcode")], known_picture], ["opening", [], opening], ["slicing", [], slicing],
  ["dense", [file("plate.gcode")], dense], ["report", [file("protected.gcode")], report], ["first", null, first_picture(file("ten-megabytes.gcode"))], ["speed", [file("two-million.gcode")], two_million],
];
try {
  for (const [name, files, tests] of groups) {
    if (only && only !== name) continue;
    if (!files) { await tests(chrome); continue; } // starts the program itself
    const server = await serve(files);
    try { await tests(chrome, server.address); } finally { server.end(); }
  }
} finally { await chrome.close(); }
process.exit(summary() ? 0 : 1);
