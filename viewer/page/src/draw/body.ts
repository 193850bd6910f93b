// The body of a print: what can be seen from outside, at several levels of detail, built from coarse to fine and
// written to the graphics card once. Moving the layer slider then only changes how many pieces of each chunk are drawn.
import * as THREE from "three";
import type { Moves } from "../data/print.ts";
import { drawn_layer, level_roads, levels, seen_from_outside, words_per_road, type Roads } from "../model/roads.ts";
import { in_slices } from "../model/slices.ts";
import { chunk_roads, RoadChunk, type RoadMaterial } from "./roads_mesh.ts";

const finer_levels = 2; // and all below it show the steps of slopes
type Upload = (mesh: THREE.Object3D) => Promise<void>;
interface Built { chunks: RoadChunk[]; roads: Roads }

export class Body {
  readonly group = new THREE.Group();
  private readonly built: (Built | null)[] = levels.map(() => null);
  private disposed = false;

  private work: Promise<void> = Promise.resolve();
  private pending = 0;

  constructor(private readonly moves: Moves, private readonly material: RoadMaterial, private key_of: (move: number) => number) { this.seen = seen_from_outside(moves); }

  /** Whether a move belongs to the body. */
  seen: (move: number) => boolean;

  /** Builds all levels, the coarsest first; `ready` hears of each. */
  build(upload: Upload, ready: () => void): void {
    this.work = this.work.then(() => this.build_levels(levels.length - 1, upload, ready));
  }

  /** Gives roads new keys, and builds the finer levels anew with what the audit knows to be visible. */
  refine(visibility: Uint8Array, key_of: (move: number) => number, upload: Upload, ready: () => void): void {
    this.pending++;
    this.key_of = key_of; // also of the levels being built
    this.work = this.work.then(async () => {
      this.seen = seen_from_outside(this.moves, visibility);
      await in_slices(this.new_keys(), () => this.disposed);
      ready();
      await this.build_levels(finer_levels, upload, ready);
      this.pending--;
    });
  }

  private *new_keys(): Generator<void, void> {
    for (const b of this.built) for (const chunk of b?.chunks ?? []) { chunk.set_keys(this.key_of); yield; }
  }

  private async build_levels(coarsest: number, upload: Upload, ready: () => void): Promise<void> {
    for (let n = coarsest; n >= 0; n--) {
      const roads = await in_slices(level_roads(this.moves, levels[n]!, this.seen), () => this.disposed);
      if (!roads) return;
      const chunks: RoadChunk[] = [];
      for (let k = 0; k < roads.count; k += chunk_roads) {
        const end = Math.min(roads.count, k + chunk_roads);
        const chunk = new RoadChunk(roads.words.subarray(words_per_road * k, words_per_road * end), roads.move.subarray(k, end), this.key_of, this.material);
        chunks.push(chunk);
        await upload(chunk.mesh);
        if (this.disposed) { chunks.forEach((c) => c.dispose()); return; }
        this.group.add(chunk.mesh);
      }
      this.built[n]?.chunks.forEach((c) => c.dispose());
      this.built[n] = { chunks, roads };
      ready();
    }
  }

  /** The finest level there is that is no finer than `level`, up to this layer costs at most `budget` roads; -1: none. */
  affordable(level: number, layer: number, budget: number): number {
    let found = -1;
    for (let n = levels.length - 1; n >= level; n--) {
      const b = this.built[n];
      if (b && (found < 0 || b.roads.layer_end[layer]! <= budget)) found = n;
    }
    return found;
  }

  /** Draws a level up to and including a layer. Returns the first layer that it leaves to others. */
  show(level: number, layer: number): number {
    this.built.forEach((b, n) => {
      if (!b) return;
      const end = n === level && layer >= 0 ? b.roads.layer_end[layer]! : 0;
      b.chunks.forEach((c, k) => c.show(Math.max(0, Math.min(c.move.length, end - k * chunk_roads))));
    });
    if (level < 0) return layer + 1;
    let first = layer + 1;
    while (first > 0 && !drawn_layer(first - 1, levels[level]!)) first--;
    return first;
  }

  roads(level: number, layer: number): number { return level < 0 || layer < 0 ? 0 : (this.built[level]?.roads.layer_end[layer] ?? 0); }
  finished(): boolean { return this.pending === 0 && this.built.every((b) => b !== null); }

  /** Resolves when nothing is written to the graphics card any more. */
  dispose(): Promise<void> {
    this.disposed = true;
    this.built.forEach((b) => b?.chunks.forEach((c) => c.dispose()));
    return this.work;
  }
}
