// What a nozzle carries at a moment, as the audit's scenario worst has it (docs/audit.md): it grows with the time since
// the nozzle last printed, and what it has left on the way is gone.
import { flag, kinds, type Audit, type Moves, type OozeRate } from "../data/print.ts";

/** Until the audit says what it assumed. */
export const usual_ooze: OozeRate = { volume_mm3: 2, time_s: 20 };

/** Last index k with values[k] <= x; -1 where there is none. */
export function last_at_most(values: ArrayLike<number>, x: number, from = 0, to = values.length): number {
  let lo = from, hi = to;
  while (lo < hi) { const m = (lo + hi) >> 1; if (values[m]! <= x) lo = m + 1; else hi = m; }
  return lo - 1 >= from ? lo - 1 : -1;
}

interface Track { begin: number[]; end: number[]; left_move: number[]; left_sum: number[] }

export class Ooze {
  private readonly tracks: Track[];
  private rates: OozeRate[] = [];
  private readonly first_s: number; // when the first nozzle begins to print

  constructor(private readonly moves: Moves, nozzles: number) {
    this.tracks = Array.from({ length: nozzles }, () => ({ begin: [], end: [], left_move: [], left_sum: [] }));
    let first = -1, before = -1;
    for (let i = 0; i < moves.count; i++) {
      const lays = (moves.flags[i]! & flag.lays) !== 0;
      const tool = lays ? moves.tool[i]! : -1;
      if (lays && first < 0) first = i;
      if (tool >= 0) {
        const t = this.tracks[tool];
        if (t && tool === before) t.end[t.end.length - 1] = i;
        else if (t) { t.begin.push(i); t.end.push(i); }
      }
      before = tool;
    }
    this.first_s = first > 0 ? moves.end_s[first - 1]! : 0;
  }

  /** Places where nozzles leave what they carry: smears, blobs, wipes. What is seen and what is hidden of a smear are two
   *  places; of a blob there is only the one that is seen. */
  set_audit(audit: Audit): void {
    const leaves = kinds.map((k) => k === "smear" || k === "inner" || k === "own" || k === "wipe");
    const { places } = audit;
    this.rates = audit.ooze;
    for (const t of this.tracks) { t.left_move = []; t.left_sum = []; }
    for (let k = 0; k < places.count; k++) {
      const t = this.tracks[places.nozzle[k]!];
      if (!t || !leaves[places.kind[k]!]) continue;
      t.left_move.push(places.move[k]!);
      const share = kinds[places.kind[k]!] === "own" ? Math.max(0.01, places.visibility[k]!) : 1;
      t.left_sum.push((t.left_sum.at(-1) ?? 0) + places.mm3[k]! / share);
    }
  }

  /** mm3 at time_s, while move `move` is made. */
  carried_mm3(nozzle: number, move: number, time_s: number): number {
    const t = this.tracks[nozzle]!;
    const k = last_at_most(t.begin, move);
    if (k >= 0 && t.end[k]! >= move) return 0;
    if (t.begin.length === 0) return 0; // never prints: cold
    const since = k >= 0 ? t.end[k]! : -1;
    const idle_s = Math.max(0, time_s - (k >= 0 ? this.moves.end_s[since]! : this.first_s));
    const left_at = (m: number) => { const at = last_at_most(t.left_move, m); return at < 0 ? 0 : t.left_sum[at]!; };
    const { volume_mm3, time_s: slowness_s } = this.rates[nozzle] ?? usual_ooze;
    return Math.max(0, volume_mm3 * (1 - Math.exp(-idle_s / slowness_s)) - (left_at(move) - left_at(since)));
  }
}
