// All tests of the page, against the real program; started by scripts/page-test.
import { execFileSync } from "node:child_process";
import { existsSync, writeFileSync } from "node:fs";
import path from "node:path";
import { two_blocks, vase } from "./gcode.mjs";
import { browser, out, program, root, serve, summary } from "./harness.mjs";
import { known_picture } from "./known_picture.mjs";
import { report } from "./report.mjs";
import { slicing } from "./slicing.mjs";
import { first_picture, two_million } from "./speed.mjs";
import { troubled } from "./troubled.mjs";
import { viewing } from "./viewing.mjs";

const model = (name) => path.join(root, "models", name);
const file = (name) => path.join(out, name);
for (const [name, protect] of [["protected.gcode", "full"], ["bare.gcode", "none"]])
  if (!existsSync(file(name))) execFileSync(program, ["slice", model("two-color-world-50mm_ocean.stl"), model("two-color-world-50mm_land.stl"), "--printer", "replicator-dual", "--protect", protect, "--quiet", "-o", file(name)], { stdio: "inherit" });
writeFileSync(file("blocks.gcode"), two_blocks());
writeFileSync(file("bad.gcode"), "; a file without a move\n");
if (!existsSync(file("ten-megabytes.gcode"))) writeFileSync(file("ten-megabytes.gcode"), vase(330000));
if (!existsSync(file("two-million.gcode"))) writeFileSync(file("two-million.gcode"), vase(2000000));

const chrome = await browser();
const only = process.argv[2];
const groups = [
  ["viewing", [file("protected.gcode"), file("bare.gcode")], viewing], ["troubled", [file("blocks.gcode"), file("bad.gcode")], troubled],
  ["known", [file("blocks.gcode")], known_picture], ["slicing", [], slicing],
  ["report", [file("protected.gcode")], report], ["first", [file("ten-megabytes.gcode")], first_picture], ["speed", [file("two-million.gcode")], two_million],
];
try {
  for (const [name, files, tests] of groups) {
    if (only && only !== name) continue;
    const server = await serve(files);
    try { await tests(chrome, server.address); } finally { server.end(); }
  }
} finally { await chrome.close(); }
process.exit(summary() ? 0 : 1);
