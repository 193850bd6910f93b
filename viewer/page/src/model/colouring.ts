// Colourings: how a road gets its colour, and the legend that tells it. Pure: moves and audit in, colours out.
import { flag, type Audit, type Kind, type Moves, type Summary } from "../data/print.ts";
import { css, heat, mix, nozzle_colours, parse_colour, rgba, viridis, type Rgba } from "./palette.ts";

export const colourings = ["extruder", "role", "speed", "visibility", "look", "smear", "hole", "zipper"] as const;
export type Colouring = (typeof colourings)[number];
export const colouring_names: Record<Colouring, string> = {
  extruder: "Extruder", role: "Role", speed: "Speed", visibility: "Visibility", look: "Predicted look", smear: "Predicted smears",
  hole: "Predicted holes", zipper: "Zippers",
};
/** Needs the audit. */
export const audited_colouring = (c: Colouring) => !["extruder", "role", "speed"].includes(c);
/** Which places a colouring draws on top of the roads. */
export const places_of: Partial<Record<Colouring, Kind>> = { look: "smear", smear: "smear", hole: "hole", zipper: "zipper" };

export interface LegendEntry { label: string; colour: string }
export interface Legend { entries: LegendEntry[]; scale?: { from: string; to: string; ramp: string[] } }

const role_colours: [RegExp, string][] = [
  [/external|outer/, "#e07a3f"], [/overhang/, "#4361a8"], [/bridge/, "#5b8fd6"],
  [/top/, "#d1495b"], [/solid/, "#b072c4"], [/gap|thin/, "#f3f0e6"], [/infill|fill/, "#9d4349"],
  [/perimeter|inner|wall/, "#f2c14e"], [/refill/, "#12b5a6"], [/rampart|shield/, "#7fb069"],
  [/skirt|brim|raft/, "#8fb8a8"], [/tower|prime|purge/, "#8aa29e"], [/support/, "#7aa95c"],
];
export function role_colour(role: string): Rgba {
  const found = role_colours.find(([pattern]) => pattern.test(role.toLowerCase()));
  return parse_colour(found ? found[1] : "#9aa0a6");
}

const neutral = rgba(176, 178, 182);
const grey = rgba(150, 152, 158);

export interface Painted { colour: (move: number) => Rgba; legend: Legend }

/** Speed at which the ramp ends: what 98 % of the plastic is laid below, so that one fast move does not flatten the rest. */
export function top_speed(moves: Moves): number {
  const histogram = new Uint32Array(65536);
  let laid = 0;
  for (let i = 0; i < moves.count; i++) if (moves.flags[i]! & flag.lays) { histogram[moves.speed[i]!]!++; laid++; }
  let below = 0;
  for (let s = 0; s < 65536; s++) { below += histogram[s]!; if (below >= 0.98 * laid) return Math.max(10, s); }
  return 65535;
}

const strip = (ramp: Uint32Array) => Array.from({ length: 9 }, (_, i) => css(ramp[Math.round((i / 8) * 255)]!));

export function painted(colouring: Colouring, summary: Summary, moves: Moves, audit: Audit | null): Painted {
  const nozzles = nozzle_colours(summary.nozzles.map((n) => n.colour));
  const { tool, role, flags, speed } = moves;
  const visible = audit?.visibility;
  if (colouring === "role") {
    const table = summary.roles.map(role_colour);
    const used = new Set<number>();
    for (let i = 0; i < moves.count; i++) if (flags[i]! & flag.lays) used.add(role[i]!);
    return { colour: (i) => table[role[i]!] ?? grey, legend: { entries: [...used].sort((a, b) => a - b).map((r) => ({ label: (summary.roles[r] ?? "?").replace(/_/g, " "), colour: css(table[r] ?? grey) })) } };
  }
  if (colouring === "speed") {
    const top = top_speed(moves);
    return { colour: (i) => viridis[Math.min(255, Math.round((255 * speed[i]!) / top))]!, legend: { entries: [], scale: { from: "0", to: `${Math.round(top / 10)} mm/s`, ramp: strip(viridis) } } };
  }
  if (colouring === "visibility" && visible) {
    return { colour: (i) => viridis[visible[i]!]!, legend: { entries: [], scale: { from: "hidden", to: "in full sight", ramp: strip(viridis) } } };
  }
  // Roads in the colours of their nozzles: plainly, or pale under the damage that is drawn on them. What lies hidden is darker.
  const pale = colouring === "smear" || colouring === "hole" || colouring === "zipper";
  const shades = nozzles.flatMap((c) => {
    const base = pale ? mix(c, neutral, 0.78) : c;
    const thrown = mix(base, neutral, pale ? 0.5 : 0.6);
    return [base, thrown].map((b) => Uint32Array.from({ length: 16 }, (_, v) => mix(rgba(0, 0, 0), b, visible ? 0.74 + (0.26 * v) / 15 : 1)));
  });
  const colour = (i: number) => shades[2 * tool[i]! + (flags[i]! & flag.auxiliary ? 1 : 0)]![visible && !(flags[i]! & flag.auxiliary) ? visible[i]! >> 4 : 15]!;
  const waste = flag.auxiliary | flag.lays;
  const entries: LegendEntry[] = summary.nozzles.map((n, i) => ({ label: `Extruder ${i + 1}${n.filament ? `, ${n.filament}` : ""}`, colour: css(pale ? mix(nozzles[i]!, neutral, 0.78) : nozzles[i]!) }));
  if (flags.some((f) => (f & waste) === waste)) entries.push({ label: "thrown away", colour: css(mix(nozzles[0]!, neutral, pale ? 0.9 : 0.6)) });
  if (colouring === "look") entries.push({ label: "smears, drawn wider than they are", colour: "" });
  const scale = colouring === "smear" || colouring === "hole" ? { from: "faint", to: "0.1 mm³", ramp: strip(heat) }
    : colouring === "zipper" ? { from: "hidden", to: "in full sight", ramp: strip(heat) } : undefined;
  return { colour, legend: scale ? { entries, scale } : { entries } };
}

/** Colour of a place: by how much is to be seen of it, or as the plastic that oozed. */
export function place_colour(colouring: Colouring, summary: Summary, audit: Audit): (place: number) => Rgba {
  const { mm3, visibility, nozzle } = audit.places;
  if (colouring === "look") {
    const nozzles = nozzle_colours(summary.nozzles.map((n) => n.colour));
    return (k) => nozzles[nozzle[k]!] ?? grey;
  }
  if (colouring === "zipper") return (k) => heat[Math.min(255, Math.round(255 * visibility[k]!))]!;
  return (k) => heat[Math.min(255, Math.round(255 * Math.sqrt(mm3[k]! / 0.1)))]!;
}
