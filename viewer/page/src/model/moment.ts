// A moment of a print: so many moves of a layer done, and a share of the next. Pure steps between moments, and time.
import type { Moves } from "../data/print.ts";

export interface Moment { layer: number; step: number; share: number }

export const steps_of = (m: Moves, layer: number) => m.layer_start[layer + 1]! - m.layer_start[layer]!;

/** The move being made; at the end of a layer its last. */
export function move_at(m: Moves, at: Moment): number {
  const first = m.layer_start[at.layer]!, end = m.layer_start[at.layer + 1]!;
  return end > first ? m.order[Math.min(end - 1, first + at.step)]! : 0;
}

const begin_s = (m: Moves, move: number) => (move > 0 ? m.end_s[move - 1]! : 0);

export function time_at(m: Moves, at: Moment): number {
  if (at.step >= steps_of(m, at.layer)) return m.end_s[move_at(m, at)]!;
  const move = move_at(m, at);
  return begin_s(m, move) + at.share * (m.end_s[move]! - begin_s(m, move));
}

/** The moment so many seconds on, or the end of the print. */
export function later(m: Moves, at: Moment, seconds: number): Moment {
  let { layer, step, share } = at;
  let left = seconds;
  for (;;) {
    if (step >= steps_of(m, layer)) {
      if (layer + 1 >= m.layer_z.length) return { layer, step: steps_of(m, layer), share: 0 };
      layer++; step = 0; share = 0;
      continue;
    }
    const move = m.order[m.layer_start[layer]! + step]!;
    const lasts = m.end_s[move]! - begin_s(m, move);
    const remains = lasts * (1 - share);
    if (left < remains) return { layer, step, share: share + left / lasts };
    left -= remains;
    step++; share = 0;
  }
}

/** The layer whose top is nearest to a height: how a second print follows the first. */
export function layer_at(layer_z: Float32Array, z_mm: number): number {
  let best = 0;
  for (let l = 1; l < layer_z.length; l++) if (Math.abs(layer_z[l]! - z_mm) < Math.abs(layer_z[best]! - z_mm)) best = l;
  return best;
}

/** The moment at which a move is done. */
export function after_move(m: Moves, move: number): Moment {
  const layer = m.layer[move]!;
  let lo = m.layer_start[layer]!, hi = m.layer_start[layer + 1]!;
  while (lo < hi) { const k = (lo + hi) >> 1; if (m.order[k]! <= move) lo = k + 1; else hi = k; }
  return { layer, step: lo - m.layer_start[layer]!, share: 0 };
}

/** Where nozzle 0 is, and how high the tips are, mm. */
export function carriage_at(m: Moves, at: Moment): [number, number, number] {
  const move = move_at(m, at);
  const share = at.step >= steps_of(m, at.layer) ? 1 : at.share;
  const before = Math.max(0, move - 1);
  const between = (a: number, b: number) => a + (b - a) * share;
  return [between(m.carriage[2 * before]!, m.carriage[2 * move]!), between(m.carriage[2 * before + 1]!, m.carriage[2 * move + 1]!),
    between(m.position[3 * before + 2]!, m.position[3 * move + 2]!)];
}
