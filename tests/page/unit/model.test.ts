import assert from "node:assert/strict";
import { test } from "node:test";
import { unpack } from "../../../viewer/page/src/data/arrays.ts";
import { by_layer, flag, type Summary } from "../../../viewer/page/src/data/print.ts";
import { chunk_roads, road_material, RoadChunk, RoadSet } from "../../../viewer/page/src/draw/roads_mesh.ts";
import { curve_of } from "../../../viewer/page/src/model/azimuth.ts";
import { colourings, KeyByte, laid_of, painted, painted_places, road_keys, type Palette } from "../../../viewer/page/src/model/colouring.ts";
import { after_move, carriage_at, later, layer_at, steps_of, time_at } from "../../../viewer/page/src/model/moment.ts";
import { Ooze } from "../../../viewer/page/src/model/ooze.ts";
import { css, heat, mix, nozzle_colours, parse_colour, rgba, viridis } from "../../../viewer/page/src/model/palette.ts";
import { add_layer, level_roads, levels, RoadBuffer } from "../../../viewer/page/src/model/roads.ts";
import { found, job_request, kind_of_file, standing_azimuth, standing_value, was_sent, with_printer, type Choice } from "../../../viewer/page/src/model/slicing.ts";
import { audit_with, moves_from, type Line } from "./prints.ts";

const all = () => true;
const circle = (n: number, layer: number): Line[] => Array.from({ length: n + 1 }, (_, i) => [20 * Math.cos((2 * Math.PI * i) / n), 20 * Math.sin((2 * Math.PI * i) / n), 0.2 * (layer + 1), i > 0, 0, layer]);
const finished = <T>(g: Generator<void, T>): T => { for (;;) { const s = g.next(); if (s.done) return s.value; } };

test("an answer without the magic is refused, and one that ends within its header", () => {
  assert.throws(() => unpack(new TextEncoder().encode("HTTP/1.1 404 nothing").buffer as ArrayBuffer), /CCARRAY1/);
  const cut = new Uint8Array(16);
  cut.set(new TextEncoder().encode("CCARRAY1"));
  cut[8] = 200;
  assert.throws(() => unpack(cut.buffer), /header/);
});

test("arrays are read at their offsets", () => {
  const json = JSON.stringify({ arrays: { a: { type: "f32", components: 1, count: 2, offset: 0 }, b: { type: "u8", components: 3, count: 1, offset: 8 } } });
  const length = Math.ceil((12 + json.length) / 8) * 8 - 12;
  const bytes = new Uint8Array(12 + length + 16);
  bytes.set(new TextEncoder().encode("CCARRAY1"));
  new DataView(bytes.buffer).setUint32(8, length, true);
  bytes.set(new TextEncoder().encode(json.padEnd(length)), 12);
  new Float32Array(bytes.buffer, 12 + length, 2).set([1.5, -2]);
  bytes.set([7, 8, 9], 12 + length + 8);
  const { columns } = unpack(bytes.buffer);
  assert.deepEqual([...columns["a"]!], [1.5, -2]);
  assert.deepEqual([...columns["b"]!], [7, 8, 9]);
});

test("moves of a layer that is come back to stay together, in the order of the file", () => {
  const { order, layer_start } = by_layer(Uint32Array.from([0, 1, 0, 1, 2]), 3);
  assert.deepEqual([...order], [0, 2, 1, 3, 4]);
  assert.deepEqual([...layer_start], [0, 2, 4, 5]);
});

test("every move that lays plastic is a road at full detail; chords on one line are one", () => {
  const square: Line[] = [[0, 0, 0.2, false, 0, 0], [10, 0, 0.2, true, 0, 0], [10, 10, 0.2, true, 0, 0], [0, 10, 0.2, false, 0, 0], [0, 5, 0.2, true, 0, 0], [0, 0, 0.2, true, 0, 0]];
  const out = new RoadBuffer(1);
  add_layer(out, moves_from(square), 0, all, levels[0]!);
  assert.deepEqual([...out.move.subarray(0, out.count)], [1, 2, 4]);
});

test("a road begins where its own nozzle was, whichever nozzle came before", () => {
  const moves = moves_from([[0, 0, 0.2, false, 0, 0], [5, 5, 0.2, true, 0, 0], [9, 5, 0.2, true, 1, 0]]);
  const out = new RoadBuffer();
  add_layer(out, moves, 0, all, levels[0]!);
  assert.deepEqual([...new Float32Array(out.words.buffer).subarray(8, 10)], [15, 5]);
});

test("coarse levels stay within their tolerance of the circle they draw", () => {
  const moves = moves_from(circle(720, 0));
  for (const level of levels) {
    const out = new RoadBuffer();
    add_layer(out, moves, 0, all, { ...level, stride: 1 });
    const f = new Float32Array(out.words.buffer);
    for (let k = 0; k < out.count; k++) {
      const middle = Math.hypot((f[8 * k]! + f[8 * k + 4]!) / 2, (f[8 * k + 1]! + f[8 * k + 5]!) / 2);
      assert.ok(20 - middle <= level.tolerance_mm + 1e-3, `${20 - middle} over ${level.tolerance_mm}`);
    }
    if (level.tolerance_mm >= 0.05) assert.ok(out.count < 100, `${out.count} roads`);
  }
});

test("a coarse level draws the top layer of each group", () => {
  const moves = moves_from([0, 1, 2, 3, 4].flatMap((l) => circle(12, l)));
  const roads = finished(level_roads(moves, { tolerance_mm: 0.001, stride: 2 }, all));
  assert.deepEqual([...roads.layer_end], [0, 12, 12, 24, 24]);
});

test("time and moment are inverse; play goes over to the next layer", () => {
  const moves = moves_from([...circle(4, 0), ...circle(4, 1)]);
  const at = later(moves, { layer: 0, step: 0, share: 0 }, 6.25);
  assert.deepEqual(at, { layer: 1, step: 1, share: 0.25 });
  assert.ok(Math.abs(time_at(moves, at) - 6.25) < 1e-6);
  assert.deepEqual(later(moves, at, 1e9), { layer: 1, step: steps_of(moves, 1), share: 0 });
  assert.deepEqual(after_move(moves, 6), { layer: 1, step: 2, share: 0 });
});

test("the carriage is half way when half of the move is done", () => {
  const moves = moves_from([[0, 0, 0.2, false, 0, 0], [10, 0, 0.2, true, 0, 0]]);
  assert.deepEqual(carriage_at(moves, { layer: 0, step: 1, share: 0.5 }).slice(0, 2), [5, 0]);
});

test("layers of two prints meet by height", () => {
  assert.equal(layer_at(Float32Array.from([0.3, 0.6, 0.9]), 0.5), 1);
  assert.equal(layer_at(Float32Array.from([0.3, 0.6, 0.9]), 50), 2);
});

test("a nozzle carries nothing while it prints, then V (1 - exp(-t / tau)) less what it has left", () => {
  const lines: Line[] = [[0, 0, 0.2, false, 0, 0], [1, 0, 0.2, true, 0, 0], [2, 0, 0.2, true, 1, 0], [3, 0, 0.2, true, 1, 0], [4, 0, 0.2, true, 1, 0]];
  const moves = moves_from(lines), ooze = new Ooze(moves, 2);
  assert.equal(ooze.carried_mm3(0, 1, 1.5), 0);
  const free = 2 * (1 - Math.exp(-3 / 20));
  assert.ok(Math.abs(ooze.carried_mm3(0, 4, 5) - free) < 1e-6);
  ooze.set_audit(audit_with([{ kind: 4, nozzle: 0, move: 3, mm3: 0.1 }, { kind: 3, nozzle: 0, move: 3, mm3: 9 }], 5));
  assert.ok(Math.abs(ooze.carried_mm3(0, 4, 5) - (free - 0.1)) < 1e-6);
  ooze.set_audit({ ...audit_with([], 5), ooze: [{ volume_mm3: 0.5, time_s: 6 }] });
  assert.ok(Math.abs(ooze.carried_mm3(0, 4, 5) - 0.5 * (1 - Math.exp(-3 / 6))) < 1e-6, "as the audit assumed it");
});

test("nozzles of one colour are told apart", () => {
  const [a, b] = nozzle_colours(["#808080", "#808080"]);
  assert.notEqual(a, b);
  assert.equal(mix(rgba(0, 0, 0), rgba(200, 100, 50), 0.5), rgba(100, 50, 25));
  assert.equal(parse_colour("#0A141E"), rgba(10, 20, 30));
});

const profiles = [
  { group: "printer" as const, name: "p", description: "", extruders: 3, default_material: "abs", default_print: "fine", settings: { layer_height: "0.3" } },
  { group: "print" as const, name: "fine", description: "", settings: { layer_height: "0.1" } },
];
const empty: Choice = { printer: "", print: "", materials: [], protect: "full", azimuth: "", meshes: [{ id: 4, wanted: 5 }], changed: new Map([["perimeters", "2"]]) };

test("a printer brings its materials and print settings, and parts keep to its extruders", () => {
  const c = with_printer(empty, profiles, "p");
  assert.deepEqual(job_request(c), { meshes: [{ id: 4, extruder: 2 }], printer: "p", materials: ["abs", "abs", "abs"], print: "fine", protect: "full", settings: { perimeters: "2" } });
  const option = { name: "layer_height", group: "print" as const, section: "Layers", kind: "number" as const, unit: "mm", per_extruder: false, help: "height of a layer", default: "0.2" };
  assert.equal(standing_value(option, profiles, c), "0.1");
  assert.ok(found(option, "layer hei") && !found(option, "layer fan"));
});

test("parts come back to their extruders after a printer that has fewer, and wait for printers not known yet", () => {
  const more = [...profiles, { group: "printer" as const, name: "single", description: "", extruders: 1, settings: {} }];
  const parts = { ...empty, meshes: [0, 1, 2].map((wanted) => ({ id: wanted, wanted })) };
  const extruders = (c: Choice) => job_request(c).meshes.map((m) => m.extruder);
  assert.deepEqual(extruders(parts), [0, 0, 0]);
  const single = with_printer(parts, more, "single");
  assert.deepEqual(extruders(single), [0, 0, 0]);
  assert.deepEqual(extruders(with_printer(single, more, "p")), [0, 1, 2]);
});

test("a level of protection sets its options over those of the profiles", () => {
  const rampart = { name: "rampart", group: "print" as const, section: "", kind: "choice" as const, unit: "", per_extruder: false, help: "", default: "auto" };
  const told = [...profiles, { group: "protection" as const, name: "none", turns: false, settings: { rampart: "off" } }];
  assert.equal(standing_value(rampart, told, with_printer({ ...empty, protect: "none" }, profiles, "p")), "off");
  assert.equal(standing_value(rampart, told, with_printer(empty, profiles, "p")), "auto");
  assert.deepEqual([standing_azimuth(told, { ...empty, protect: "none" }), standing_azimuth(told, empty)], ["off", "auto"]);
});

test("files are known by their names", () => {
  assert.deepEqual(["a.STL", "b.gcode", "c.3mf", "my.toml", "d.exe"].map(kind_of_file), ["mesh", "gcode", "mesh", "printer", "unknown"]);
});

/** As the graphics card does it. */
const looked_up = ({ colours, column, row }: Palette, key: number) => colours[256 * (row === null ? 0 : (key >>> (8 * row)) & 255) + ((key >>> (8 * column)) & 255)]!;
const two_nozzles = { nozzles: [{ colour: "#cc4422" }, { colour: "#2244cc" }], roles: ["external_perimeter", "rampart", "unknown"] } as unknown as Summary;

/** A wall of each tool, and a rampart of the second. */
function three_roads() {
  const moves = moves_from([[0, 0, 0.2, false, 0, 0], [10, 0, 0.2, true, 0, 0], [20, 0, 0.2, true, 1, 0], [30, 0, 0.2, true, 1, 0]]);
  moves.role[3] = 1;
  moves.flags[3]! |= flag.auxiliary;
  return moves;
}

test("a road's colour is looked up by its key, in any colouring", () => {
  const moves = three_roads(), laid = laid_of(moves), [first, second] = nozzle_colours(two_nozzles.nozzles.map((n) => n.colour));
  const colour = (colouring: (typeof colourings)[number], visibility?: number[]) => {
    const key = road_keys(moves, laid, visibility && Uint8Array.from(visibility)), { palette } = painted(colouring, two_nozzles, laid, visibility !== undefined);
    return [1, 2, 3].map((move) => looked_up(palette, key(move)));
  };
  const thrown_away = mix(second!, rgba(176, 178, 182), 0.6);
  assert.deepEqual(colour("extruder"), [first, second, thrown_away]);
  assert.deepEqual(colour("extruder", [0, 255, 0, 255]), [first, mix(rgba(0, 0, 0), second!, 0.74), thrown_away], "what lies hidden is darker");
  assert.deepEqual(colour("role").map(css), ["rgb(224 122 63)", "rgb(224 122 63)", "rgb(127 176 105)"]);
  assert.deepEqual(colour("visibility", [0, 255, 7, 0]), [viridis[255], viridis[7], viridis[0]]);
  moves.speed.set([0, 0, 300, 600]);
  assert.deepEqual(colour("speed"), [viridis[0], viridis[128], viridis[255]]);
});

test("legends name the roles laid, and what is thrown away", () => {
  const moves = three_roads();
  assert.deepEqual(painted("role", two_nozzles, laid_of(moves), false).legend.entries.map((e) => e.label), ["external perimeter", "rampart"]);
  const labels = () => painted("extruder", two_nozzles, laid_of(moves), false).legend.entries.map((e) => e.label);
  assert.deepEqual(labels(), ["Extruder 1", "Extruder 2", "thrown away"]);
  moves.flags[3]! &= ~flag.auxiliary;
  assert.deepEqual(labels(), ["Extruder 1", "Extruder 2"]);
});

test("the ramp of speeds ends where 98 % of the plastic is laid below", () => {
  const moves = moves_from(Array.from({ length: 102 }, (_, i): Line => [i, 0, 0.2, i > 0, 0, 0]));
  moves.speed.fill(500);
  moves.speed.set([2000, 2000], 50);
  assert.equal(laid_of(moves).top_speed, 500);
  assert.equal(road_keys(moves, laid_of(moves), undefined)(50) >>> (8 * KeyByte.speed) & 255, 255);
});

test("places are coloured by how much of them is to be seen, or as the plastic that oozed", () => {
  const audit = audit_with([{ kind: 0, nozzle: 1, move: 2, mm3: 0.025 }], 4);
  const colour = (colouring: "smear" | "look") => { const { palette, key } = painted_places(colouring, two_nozzles, audit); return looked_up(palette, key(0)); };
  assert.equal(colour("smear"), heat[128]);
  assert.equal(colour("look"), nozzle_colours(two_nozzles.nozzles.map((n) => n.colour))[1]);
});

test("roads beyond what a chunk holds go into further chunks, and all of them are drawn", () => {
  const material = road_material(), n = 2 * chunk_roads + 500;
  const buffer = new RoadBuffer(), from = [0, 0], to = new Float32Array(3);
  for (let k = 0; k < n; k++) buffer.put(from, 0, to, 0, 40, 20, false, k);
  const set = RoadSet.of(buffer, (move) => move, material);
  /** Corners each chunk gives to the graphics card: not beyond its index, as three has it. */
  const drawn = () => (set.group.children as RoadChunk["mesh"][]).map(({ visible, geometry: { drawRange, index } }) => (visible ? Math.min(drawRange.count, index!.count) / 12 : 0));
  for (const [asked, each] of [[n, [chunk_roads, chunk_roads, 500]], [chunk_roads + 7, [chunk_roads, 7, 0]], [chunk_roads, [chunk_roads, 0, 0]], [3, [3, 0, 0]], [0, [0, 0, 0]]] as const) {
    set.show(asked);
    assert.deepEqual(drawn(), each);
    assert.equal(set.shown, asked);
  }
  const last = set.group.children[2] as RoadChunk["mesh"];
  assert.equal((last.material.uniforms as unknown as { keys: { value: { image: { data: Uint32Array } } } }).keys.value.image.data[499], n - 1);
  assert.throws(() => new RoadChunk(buffer.words, buffer.move.subarray(0, chunk_roads + 1), () => 0, material), /do not fit/);
  set.dispose();
});

test("the curve of the azimuth is broken where there is no room, as high as what is drawn, and goes round", () => {
  const azimuth = { candidates_deg: [270, 0, 90, 180, 359, 45], exposure_s: [5, 1, 99, 3, 4, 2], interference_mm3: [], fits: [true, true, false, true, true, true], chosen_deg: 0 };
  const curve = curve_of(azimuth, 359.8)!;
  assert.deepEqual(curve.runs, [[1, 5], [3, 0, 4]]);
  assert.deepEqual([curve.first_deg, curve.last_deg, curve.most_s], [0, 359, 5]);
  assert.equal(curve.nearest, 1);
  assert.equal(curve_of(azimuth, 100)!.nearest, 5);
  assert.equal(curve_of({ ...azimuth, fits: azimuth.fits.map(() => false) }, 0), null);
});

test("printers that were sent can be told from those built in and that of the command line", () => {
  const printer = (name: string, more = {}) => ({ group: "printer" as const, name, settings: {}, ...more });
  assert.deepEqual([printer("mine.toml"), printer("bench.toml", { chosen: true }), printer("generic"), { ...printer("x.toml"), group: "print" as const }].map(was_sent), [true, false, false, false]);
});
