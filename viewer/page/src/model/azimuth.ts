// The curve of exposure over the angle: its pieces between angles at which the print has no room, and what is chosen.
import type { Azimuth } from "../data/print.ts";

export interface Curve {
  runs: number[][]; // candidates next to each other, by angle, all of which fit
  first_deg: number;
  last_deg: number;
  most_s: number; // of those that fit
  nearest: number; // candidate that fits, nearest to the angle chosen
}

/** How far two angles are apart, round the circle. */
const apart_deg = (a: number, b: number) => { const d = Math.abs(a - b) % 360; return Math.min(d, 360 - d); };

/** Null where no angle leaves room. */
export function curve_of({ candidates_deg, exposure_s, fits }: Azimuth, chosen_deg: number): Curve | null {
  const runs: number[][] = [];
  let open = false;
  for (const i of candidates_deg.map((_, i) => i).sort((a, b) => candidates_deg[a]! - candidates_deg[b]!)) {
    if (fits[i] !== false) { if (open) runs.at(-1)!.push(i); else runs.push([i]); }
    open = fits[i] !== false;
  }
  const drawn = runs.flat();
  if (drawn.length === 0) return null;
  return {
    runs, first_deg: candidates_deg[drawn[0]!]!, last_deg: candidates_deg[drawn.at(-1)!]!, most_s: Math.max(...drawn.map((i) => exposure_s[i]!)),
    nearest: drawn.reduce((best, i) => (apart_deg(candidates_deg[i]!, chosen_deg) < apart_deg(candidates_deg[best]!, chosen_deg) ? i : best)),
  };
}
