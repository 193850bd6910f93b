// One print in the scene: body, the layers at the cut in full, places of damage, nozzles, lines. It is told what to
// show and chooses before each frame how finely.
import * as THREE from "three";
import { box_of, by_layer, kinds, type Audit, type Moves, type Summary } from "../data/print.ts";
import { laid_of, painted, painted_places, places_of, road_keys, type Colouring, type Laid, type Legend } from "../model/colouring.ts";
import { add_layer, levels, RoadBuffer } from "../model/roads.ts";
import { bed, dispose_bed } from "./bed.ts";
import { Body } from "./body.ts";
import { Idle } from "./idle.ts";
import { dispose_palette, road_material, RoadSet, set_palette } from "./roads_mesh.ts";
import type { Stage, View } from "./stage.ts";

export interface Shown {
  from_layer: number;
  layer: number;
  step: number; // moves of the layer that are done
  share: number; // of the move after those
}
export type RampartShown = "whole" | "open" | "hidden";
export interface Look { colouring: Colouring; rampart: RampartShown; travel: boolean; idle: boolean; dark: boolean }

// Below the cut, infill shows through the layers above it: so many layers are drawn in full.
const fewest_full = 3, most_full = 14, full_roads = 9000;
const exact = levels[0]!;

export class PrintView implements View {
  readonly scene = new THREE.Scene();
  readonly material = road_material();
  readonly place_material = road_material();
  private shared_top_speed = 0;
  readonly idle: Idle;
  legend: Legend = { entries: [] };
  audit: Audit | null = null;
  private readonly body: Body;
  private readonly root = new THREE.Group();
  private top: RoadSet | null = null;
  private under: RoadSet | null = null;
  private floor: RoadSet | null = null;
  private places: RoadSet | null = null;
  private places_by_layer: ReturnType<typeof by_layer> = { order: new Uint32Array(), layer_start: new Uint32Array() };
  private readonly place_end: Uint32Array; // of the places drawn, up to and including a layer
  private place_index: Uint32Array = new Uint32Array();
  private bed: THREE.Object3D | null = null;
  private readonly laid: Laid;
  private key_of: (move: number) => number;
  shown: Shown;
  private look: Look;
  private under_key = "";
  private first_drawn: (() => void) | null = null;
  readonly first_picture = new Promise<void>((r) => { this.first_drawn = r; });

  constructor(readonly summary: Summary, readonly moves: Moves, private readonly stage: Stage, look: Look) {
    this.look = look;
    this.shown = { from_layer: 0, layer: moves.layer_z.length - 1, step: Infinity, share: 0 };
    this.laid = laid_of(moves);
    this.place_end = new Uint32Array(moves.layer_z.length);
    this.key_of = road_keys(moves, this.laid, undefined);
    this.body = new Body(moves, this.material, this.key_of);
    this.idle = new Idle(summary, moves);
    this.scene.matrixAutoUpdate = false;
    this.scene.add(this.root);
    this.root.add(this.body.group, this.idle.group);
    this.place_material.uniforms.grow.value = 0.08;
    const [low, high] = box_of(summary);
    for (const m of [this.material, this.place_material]) m.uniforms.middle.value.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2);
    this.set_look(look);
    this.recolour();
    this.body.build((mesh) => stage.upload(mesh), () => stage.ask());
  }

  /** Where the ramp of speeds ends: of this print, or of all that are shown. 0.1 mm/s */
  get top_speed(): number { return this.shared_top_speed || this.laid.top_speed; }
  set top_speed(shared: number) {
    this.shared_top_speed = shared;
    this.recolour();
  }

  set_audit(audit: Audit): void {
    this.audit = audit;
    this.places_by_layer = by_layer(audit.places.layer, this.moves.layer_z.length);
    this.idle.set_audit(audit);
    this.key_of = road_keys(this.moves, this.laid, audit.visibility);
    for (const c of [this.top, this.under, this.floor]) if (c) for (const _ of c.new_keys(this.key_of));
    this.body.refine(audit.visibility, this.key_of, (mesh) => this.stage.upload(mesh), () => this.stage.ask());
    this.recolour();
  }

  set_look(look: Look): void {
    const repaint = look.colouring !== this.look.colouring;
    const dark_changed = look.dark !== this.look.dark;
    this.look = look;
    this.material.uniforms.rampart.value = { hidden: 0, open: 1, whole: 2 }[look.rampart];
    this.idle.set_look(look);
    if (!this.bed || dark_changed) {
      if (this.bed) dispose_bed(this.bed);
      this.root.add((this.bed = bed(this.summary, look.dark)));
    }
    if (repaint) this.recolour(); else this.stage.ask();
  }

  show(shown: Shown): void {
    const layer_changed = shown.layer !== this.shown.layer || shown.from_layer !== this.shown.from_layer;
    this.shown = shown;
    if (layer_changed) this.place_cut();
    this.show_step();
  }

  has_layers_of(z_mm: number): boolean { return z_mm <= this.moves.layer_z[this.moves.layer_z.length - 1]! + 1e-3; }

  prepare(pixels_per_mm: number, budget_roads: number): number {
    if (!this.top) this.place_cut();
    const { layer } = this.shown;
    const height_mm = this.moves.layer_height[layer] ?? 0.2;
    this.material.uniforms.detail.value = this.place_material.uniforms.detail.value = Math.max(0, Math.min(1, (height_mm * pixels_per_mm - 1.5) / 3.5));
    // The coarsest level whose chords err by less than half a pixel and whose layers are not told apart.
    let wanted = 0;
    while (wanted + 1 < levels.length && levels[wanted + 1]!.tolerance_mm * pixels_per_mm < 0.6 && levels[wanted + 1]!.stride * height_mm * pixels_per_mm < 2.6) wanted++;
    const level = this.body.affordable(wanted, Math.max(0, layer - 1), budget_roads);
    const left = this.body.show(level, layer - 1);
    this.fill_under(Math.max(this.shown.from_layer, left), level >= 0);
    if (level >= 0 && this.first_drawn) { const done = this.first_drawn; this.first_drawn = null; void this.stage.frame_done().then(done); }
    const shown = (c: RoadSet | null) => c?.shown ?? 0;
    return this.body.roads(level, layer - 1) + shown(this.top) + shown(this.under) + shown(this.floor) + shown(this.places);
  }

  /** Pieces drawn of each kind, for tests. */
  counts(): Record<string, number> {
    const shown = (c: RoadSet | null) => c?.shown ?? 0;
    return { top: shown(this.top), under: shown(this.under), floor: shown(this.floor), places_drawn: shown(this.places), finished: this.body.finished() ? 1 : 0 };
  }

  /** Places drawn, for tests. */
  places_shown(): number[] { return [...this.place_index.subarray(0, this.places?.shown ?? 0)]; }

  dispose(): void {
    for (const c of [this.top, this.under, this.floor, this.places]) c?.dispose();
    this.idle.dispose();
    if (this.bed) dispose_bed(this.bed);
    // A part of the body that is just being written would bring its palette back.
    void this.body.dispose().then(() => { for (const m of [this.material, this.place_material]) { dispose_palette(m); m.dispose(); } });
  }

  private roads_of(buffer: RoadBuffer): RoadSet {
    const roads = RoadSet.of(buffer, this.key_of, this.material);
    this.root.add(roads.group);
    return roads;
  }

  /** The layer at the cut, and the lowest shown, in full. */
  private place_cut(): void {
    const { layer, from_layer } = this.shown;
    const { layer_z, layer_height } = this.moves;
    const z = from_layer > 0 ? layer_z[from_layer]! - (layer_height[from_layer] ?? 0.2) * 0.5 : -1e9;
    this.material.uniforms.cut_below_z.value = this.place_material.uniforms.cut_below_z.value = z;
    this.top?.dispose();
    const top = new RoadBuffer();
    add_layer(top, this.moves, layer, () => true, exact);
    this.top = this.roads_of(top);
    this.floor?.dispose();
    this.floor = null;
    if (from_layer > 0 && from_layer < layer) {
      const floor = new RoadBuffer();
      add_layer(floor, this.moves, from_layer, () => true, exact);
      this.floor = this.roads_of(floor);
      this.floor.show(floor.count);
    }
    this.under_key = "";
    this.idle.set_layer(layer);
    this.show_step();
  }

  private show_step(): void {
    const { layer, step, share } = this.shown;
    const { order, layer_start } = this.moves;
    const first = layer_start[layer]!, end = layer_start[layer + 1]!;
    const k = Math.min(end, first + step);
    const last = k > first ? order[k - 1]! : -1;
    // Pieces are in the order of the moves: those that begin with a move done are drawn.
    if (this.top) {
      const { move } = this.top;
      let lo = 0, hi = move.length;
      while (lo < hi) { const m = (lo + hi) >> 1; if (move[m]! <= last) lo = m + 1; else hi = m; }
      this.top.show(lo);
    }
    if (this.places) this.places.show(this.places_until(layer, k < end ? last : Infinity));
    this.idle.set_step(k - first, share);
    this.stage.move();
  }

  private places_until(layer: number, move: number): number {
    const at = this.audit!.places.move;
    const begin = layer > 0 ? this.place_end[layer - 1]! : 0;
    let n = this.place_end[layer] ?? 0;
    while (n > begin && at[this.place_index[n - 1]!]! > move) n--;
    return n;
  }

  /** Layers just below the cut: the highest few in full, of others that the body's level leaves out what can be seen. */
  private fill_under(left: number, body: boolean): void {
    const { layer, from_layer } = this.shown;
    const { layer_start } = this.moves;
    let full = layer; // lowest layer drawn in full
    while (full > from_layer && (layer - full < fewest_full || (layer - full < most_full && layer_start[layer]! - layer_start[full - 1]! < full_roads))) full--;
    const first = Math.max(from_layer, body ? Math.min(left, full) : full);
    const key = `${first} ${layer}`;
    if (key === this.under_key) return;
    this.under_key = key;
    this.under?.dispose();
    const buffer = new RoadBuffer();
    for (let l = first; l < layer; l++) add_layer(buffer, this.moves, l, l >= full ? () => true : this.body.seen, l >= full ? exact : levels[1]!);
    this.under = this.roads_of(buffer);
    this.under.show(buffer.count);
  }

  private recolour(): void {
    const { palette, legend } = painted(this.look.colouring, this.summary, this.laid, this.audit !== null, this.top_speed);
    set_palette(this.material, palette);
    this.legend = legend;
    this.build_places();
    this.stage.move();
  }

  /** Smears, holes or zippers of the colouring, by layer, a little thicker than the roads they lie on. */
  private build_places(): void {
    this.places?.dispose();
    this.places = null;
    const kind = places_of[this.look.colouring];
    if (!this.audit || !kind) return;
    const { places } = this.audit, wanted = kinds.indexOf(kind), { order, layer_start } = this.places_by_layer;
    const { palette, key } = painted_places(this.look.colouring, this.summary, this.audit);
    set_palette(this.place_material, palette);
    const buffer = new RoadBuffer();
    for (let l = 0; l < this.place_end.length; l++) {
      const height = Math.min(255, Math.round(115 * (this.moves.layer_height[l] ?? 0.2)));
      for (const k of order.subarray(layer_start[l]!, layer_start[l + 1]!)) {
        if (places.kind[k] !== wanted || (kind === "zipper" && places.visibility[k]! <= 0.02)) continue;
        const width = kind === "zipper" ? 45 : Math.min(140, 32 + 180 * Math.sqrt(places.mm3[k]!));
        buffer.put(places.from, 3 * k, places.to, 3 * k, Math.round(width), height, false, k);
      }
      this.place_end[l] = buffer.count;
    }
    this.places = RoadSet.of(buffer, key, this.place_material);
    this.place_index = this.places.move;
    this.root.add(this.places.group);
    this.show_step();
  }
}
