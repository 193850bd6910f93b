// The body of a print: what can be seen from outside, at several levels of detail, built from coarse to fine and
// written to the graphics card once. Moving the layer slider then only changes how many pieces of each chunk are drawn.
import * as THREE from "three";
import type { Moves } from "../data/print.ts";
import { drawn_layer, level_roads, levels, seen_from_outside } from "../model/roads.ts";
import { in_slices } from "../model/slices.ts";
import { RoadSet, type RoadMaterial } from "./roads_mesh.ts";

const finer_levels = 2; // and all below it show the steps of slopes
type Upload = (mesh: THREE.Object3D) => Promise<void>;
interface Built { roads: RoadSet; layer_end: Uint32Array }

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
    for (const b of this.built) if (b) yield* b.roads.new_keys(this.key_of);
  }

  private async build_levels(coarsest: number, upload: Upload, ready: () => void): Promise<void> {
    for (let n = coarsest; n >= 0; n--) {
      const found = await in_slices(level_roads(this.moves, levels[n]!, this.seen), () => this.disposed);
      if (!found) return;
      const roads = new RoadSet(found, this.material);
      for (const chunk of roads.build(this.key_of)) {
        await upload(chunk.mesh);
        if (this.disposed) { roads.dispose(); return; }
      }
      this.group.add(roads.group);
      this.built[n]?.roads.dispose();
      this.built[n] = { roads, layer_end: found.layer_end };
      ready();
    }
  }

  /** The finest level there is that is no finer than `level`, up to this layer costs at most `budget` roads; -1: none. */
  affordable(level: number, layer: number, budget: number): number {
    let found = -1;
    for (let n = levels.length - 1; n >= level; n--) {
      const b = this.built[n];
      if (b && (found < 0 || b.layer_end[layer]! <= budget)) found = n;
    }
    return found;
  }

  /** Draws a level up to and including a layer. Returns the first layer that it leaves to others. */
  show(level: number, layer: number): number {
    this.built.forEach((b, n) => {
      if (!b) return;
      b.roads.show(n === level && layer >= 0 ? b.layer_end[layer]! : 0);
    });
    if (level < 0) return layer + 1;
    let first = layer + 1;
    while (first > 0 && !drawn_layer(first - 1, levels[level]!)) first--;
    return first;
  }

  roads(level: number, layer: number): number { return level < 0 || layer < 0 ? 0 : (this.built[level]?.layer_end[layer] ?? 0); }
  finished(): boolean { return this.pending === 0 && this.built.every((b) => b !== null); }

  /** Resolves when nothing is written to the graphics card any more. */
  dispose(): Promise<void> {
    this.disposed = true;
    this.built.forEach((b) => b?.roads.dispose());
    return this.work;
  }
}
