// Colourings: how a road gets its colour, and the legend that tells it. Pure: moves and audit in, keys and colours out.
//
//   move  ->  its key, the same for all colourings  ->  the colouring's palette  ->  colour
//
// The graphics card looks keys up, so that another colouring costs another palette, however many roads there are.
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

const strip = (ramp: Uint32Array) => Array.from({ length: 9 }, (_, i) => css(ramp[Math.round((i / 8) * 255)]!));

/** What is told of all plastic laid: found once, for it takes a pass over all moves. */
export interface Laid {
  roles: number[]; // ascending
  top_speed: number; // 0.1 mm/s: where the ramp ends; 98 % is laid below, so that one fast move does not flatten the rest
  thrown_away: boolean; // some of it is
}
export function laid_of(moves: Moves): Laid {
  const { role, flags, speed, count } = moves, speeds = new Uint32Array(65536), roles = new Uint32Array(256);
  let all = 0, auxiliary = 0;
  for (let i = 0; i < count; i++) {
    if (!(flags[i]! & flag.lays)) continue;
    speeds[speed[i]!]!++;
    roles[role[i]!]!++;
    auxiliary |= flags[i]! & flag.auxiliary;
    all++;
  }
  let top_speed = 0;
  for (let below = speeds[0]!; top_speed < 65535 && below < 0.98 * all; ) below += speeds[++top_speed]!;
  return { roles: [...roles.keys()].filter((r) => roles[r]! > 0), top_speed: Math.max(10, top_speed), thrown_away: auxiliary !== 0 };
}

/** The bytes of a road's key, from the lowest: what any colouring asks of it. */
export enum KeyByte { plastic, role, speed, visibility }

/** The key of a move's road. Plastic: 2 x tool + 1 where it is thrown away; speed and visibility in 255ths; where there is
 *  no audit all is in full sight. */
export function road_keys(moves: Moves, laid: Laid, visibility: Uint8Array | undefined): (move: number) => number {
  const { tool, role, speed, flags } = moves;
  return (i) => {
    const thrown = (flags[i]! & flag.auxiliary) !== 0 ? 1 : 0;
    const fast = Math.min(255, Math.round((255 * speed[i]!) / laid.top_speed)), seen = visibility ? visibility[i]! : 255;
    return ((2 * tool[i]! + thrown) | (role[i]! << 8) | (fast << 16) | (seen << 24)) >>> 0;
  };
}

/** How keys become colours: rows of 256, the column told by one byte of the key, the row by another. */
export interface Palette { colours: Uint32Array; column: KeyByte; row: KeyByte | null }
export interface Painted { palette: Palette; legend: Legend }

const one_row = (colours: Uint32Array, column: KeyByte): Palette => ({ colours, column, row: null });

/** top_speed: where the ramp ends, the same for all prints that are shown; not below that of `laid`. */
export function painted(colouring: Colouring, summary: Summary, laid: Laid, audited: boolean, top_speed = laid.top_speed): Painted {
  if (colouring === "role") {
    const name = (r: number) => (summary.roles[r] ?? "?").replace(/_/g, " ");
    const table = Uint32Array.from({ length: 256 }, (_, r) => (r < summary.roles.length ? role_colour(summary.roles[r]!) : grey));
    return { palette: one_row(table, KeyByte.role), legend: { entries: laid.roles.map((r) => ({ label: name(r), colour: css(table[r]!) })) } };
  }
  if (colouring === "speed") {
    const ramp = viridis.map((_, k) => viridis[Math.round((k * laid.top_speed) / top_speed)]!);
    return { palette: one_row(ramp, KeyByte.speed), legend: { entries: [], scale: { from: "0", to: `${Math.round(top_speed / 10)} mm/s`, ramp: strip(viridis) } } };
  }
  if (colouring === "visibility" && audited) return { palette: one_row(viridis, KeyByte.visibility), legend: { entries: [], scale: { from: "hidden", to: "in full sight", ramp: strip(viridis) } } };
  // Roads in the colours of their nozzles: plainly, or pale under the damage that is drawn on them. What lies hidden is darker.
  const nozzles = nozzle_colours(summary.nozzles.map((n) => n.colour));
  const pale = colouring === "smear" || colouring === "hole" || colouring === "zipper";
  const colours = new Uint32Array(256 * Math.max(1, 2 * nozzles.length));
  nozzles.forEach((c, tool) => {
    const base = pale ? mix(c, neutral, 0.78) : c;
    const shades = Array.from({ length: 16 }, (_, v) => mix(rgba(0, 0, 0), base, 0.74 + (0.26 * v) / 15));
    for (let v = 0; v < 256; v++) colours[512 * tool + v] = shades[v >> 4]!;
    colours.fill(mix(base, neutral, pale ? 0.5 : 0.6), 512 * tool + 256, 512 * tool + 512);
  });
  const entries: LegendEntry[] = summary.nozzles.map((n, i) => ({ label: `Extruder ${i + 1}${n.filament ? `, ${n.filament}` : ""}`, colour: css(pale ? mix(nozzles[i]!, neutral, 0.78) : nozzles[i]!) }));
  if (laid.thrown_away) entries.push({ label: "thrown away", colour: css(mix(nozzles[0]!, neutral, pale ? 0.9 : 0.6)) });
  if (colouring === "look") entries.push({ label: "smears, drawn wider than they are", colour: "" });
  const scale = colouring === "smear" || colouring === "hole" ? { from: "faint", to: "0.1 mm³", ramp: strip(heat) }
    : colouring === "zipper" ? { from: "hidden", to: "in full sight", ramp: strip(heat) } : undefined;
  return { palette: { colours, column: KeyByte.visibility, row: KeyByte.plastic }, legend: scale ? { entries, scale } : { entries } };
}

/** Colours of places: by how much is to be seen of one, or as the plastic that oozed; their keys are columns. */
export function painted_places(colouring: Colouring, summary: Summary, audit: Audit): { palette: Palette; key: (place: number) => number } {
  const { mm3, visibility, nozzle } = audit.places;
  if (colouring === "look") {
    const colours = new Uint32Array(256).fill(grey);
    colours.set(nozzle_colours(summary.nozzles.map((n) => n.colour)));
    return { palette: one_row(colours, 0), key: (k) => nozzle[k]! };
  }
  const share = colouring === "zipper" ? (k: number) => visibility[k]! : (k: number) => Math.sqrt(mm3[k]! / 0.1);
  return { palette: one_row(heat, 0), key: (k) => Math.min(255, Math.round(255 * share(k))) };
}
