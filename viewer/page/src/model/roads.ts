// Roads: what is drawn of the plastic laid, as straight pieces, in the order of the layers.
//
//   moves, which of them, how coarse  ->  pieces, and where each layer's begin
//
// A coarse level joins chords that stay within `tolerance_mm` of one line, and draws one layer of `stride`, as high as
// all of them together. Seen from afar it looks the same and costs a fraction.
import { flag, start_of, type Moves } from "../data/print.ts";

export interface Level { tolerance_mm: number; stride: number }
/** From fine to coarse. A level serves where its tolerance is below a pixel, or where the machine cannot draw a finer one in time. */
export const levels: Level[] = [
  { tolerance_mm: 0.004, stride: 1 },
  { tolerance_mm: 0.05, stride: 1 },
  { tolerance_mm: 0.12, stride: 2 },
  { tolerance_mm: 0.3, stride: 4 },
  { tolerance_mm: 0.6, stride: 8 },
];

/** 32-bit words of a road: ax ay az size bx by bz auxiliary; coordinates are floats in mm, of the middle of the top edge;
 *  size is width + 256 height in 0.01 mm; auxiliary is 1 or 0. The graphics card reads them as two texels. */
export const words_per_road = 8;

export interface Roads {
  count: number;
  words: Uint32Array;
  move: Uint32Array; // which gives its colour
  layer_end: Uint32Array; // pieces up to and including a layer
}

/** Room for roads that grows as needed. */
export class RoadBuffer {
  count = 0;
  words: Uint32Array;
  move: Uint32Array;
  private floats: Float32Array; // the same memory as words
  constructor(capacity = 1024) {
    this.words = new Uint32Array(words_per_road * capacity);
    this.floats = new Float32Array(this.words.buffer);
    this.move = new Uint32Array(capacity);
  }

  /** The piece from where move `a` begins to where move `b` ends; width and height of `a`, as many layers high as `stride`. */
  add(moves: Moves, a: number, b: number, stride: number): void {
    this.put(start_of(moves, a), 0, moves.position, 3 * b, moves.width[a]!, Math.min(255, moves.height[a]! * stride), (moves.flags[a]! & flag.auxiliary) !== 0, a);
  }

  /** A piece between two points given by their first coordinate's index. A road lies flat, whatever height the nozzle came from. */
  put(from: ArrayLike<number>, f: number, to: Float32Array, t: number, width: number, height: number, auxiliary: boolean, move: number): void {
    const n = this.count++, w = words_per_road * n;
    if (n === this.move.length) this.grow();
    const { floats, words } = this;
    floats[w] = from[f]!;
    floats[w + 1] = from[f + 1]!;
    floats[w + 2] = to[t + 2]!;
    words[w + 3] = width + 256 * height;
    floats[w + 4] = to[t]!;
    floats[w + 5] = to[t + 1]!;
    floats[w + 6] = to[t + 2]!;
    words[w + 7] = auxiliary ? 1 : 0;
    this.move[n] = move;
  }

  private grow(): void {
    const double = (old: Uint32Array) => { const made = new Uint32Array(2 * old.length); made.set(old); return made; };
    this.words = double(this.words);
    this.floats = new Float32Array(this.words.buffer);
    this.move = double(this.move);
  }
}

const same_road = (m: Moves, a: number, b: number) => m.tool[a] === m.tool[b] && m.role[a] === m.role[b] && m.flags[a] === m.flags[b];

/** Distance of point k from the line between the start of the run and the end of move b. */
function off_line(p: Float32Array, [ax, ay]: [number, number], k: number, b: number): number {
  const dx = p[3 * b]! - ax, dy = p[3 * b + 1]! - ay;
  const ex = p[3 * k]! - ax, ey = p[3 * k + 1]! - ay;
  const length = Math.hypot(dx, dy);
  const along = dx * ex + dy * ey;
  if (length < 1e-6 || along < 0 || along > length * length) return Math.hypot(ex, ey);
  return Math.abs(dx * ey - dy * ex) / length;
}

const longest_run = 24; // chords joined at most: bounds the cost of looking back

/** Adds the roads of one layer: of moves.order[begin..end), those that `wanted` says. */
export function add_layer(out: RoadBuffer, moves: Moves, layer: number, wanted: (move: number) => boolean, level: Level): void {
  const { position, flags, order, layer_start } = moves;
  let first = -1, last = -1; // of the run
  let start: [number, number] = [0, 0];
  const flush = () => { if (first > 0) out.add(moves, first, last, level.stride); first = -1; };
  for (let k = layer_start[layer]!; k < layer_start[layer + 1]!; k++) {
    const i = order[k]!;
    if (!(flags[i]! & flag.lays) || !(flags[i]! & flag.start_known) || i === 0 || !wanted(i)) { flush(); continue; }
    if (first > 0 && i === last + 1 && i - first < longest_run && same_road(moves, first, i)) {
      let fits = true;
      for (let j = first; fits && j < i; j++) fits = off_line(position, start, j, i) <= level.tolerance_mm;
      if (fits) { last = i; continue; }
    }
    flush();
    first = last = i;
    start = start_of(moves, i);
  }
  flush();
}

/** Layers a level draws: the top one of each group. */
export const drawn_layer = (layer: number, level: Level) => layer % level.stride === level.stride - 1;

/** Whether a move can be seen from outside: walls, tops and auxiliary plastic; once audited also what shows between the
 *  steps of a slope. */
export function seen_from_outside(moves: Moves, visibility?: Uint8Array): (move: number) => boolean {
  const { flags } = moves, outer = flag.outermost | flag.auxiliary, plainly = 20; // of 255
  return (i) => (flags[i]! & outer) !== 0 || (visibility !== undefined && visibility[i]! > plainly);
}

/** All layers of a level, a layer at each step, so that the caller can pause. */
export function* level_roads(moves: Moves, level: Level, seen: (move: number) => boolean): Generator<void, Roads> {
  const out = new RoadBuffer(1 << 14);
  const layers = moves.layer_z.length;
  const layer_end = new Uint32Array(layers);
  for (let layer = 0; layer < layers; layer++) {
    if (drawn_layer(layer, level)) add_layer(out, moves, layer, seen, level);
    layer_end[layer] = out.count;
    yield;
  }
  return { count: out.count, words: out.words, move: out.move, layer_end };
}
