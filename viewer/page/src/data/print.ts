// A print as the page holds it: one typed array per property of its moves, in the order of the file, and an index of
// the moves of each layer. What the audit found comes later and beside it.
import { column, unpack } from "./arrays.ts";

export const flag = { lays: 1, start_known: 2, outermost: 4, tool_changed: 8, auxiliary: 16 } as const;

export interface Nozzle { offset_mm: [number, number]; colour: string; filament: string; part_g: number; auxiliary_g: number; used?: boolean }
export interface Azimuth { candidates_deg: number[]; exposure_s: number[]; interference_mm3: number[]; fits: boolean[]; chosen_deg: number | null }
export type Box = [[number, number, number], [number, number, number]];
export interface Summary {
  name: string; producer: string; dialect: string; moves: number; layers: number; tools: number; tool_changes: number;
  print_time_s: number; travel_mm: number; nozzles: Nozzle[]; idle_nozzle: string; bed_mm: [number, number][];
  box_mm: Box | null; part_box_mm: Box | null; roles: string[]; warnings: string[]; azimuth: Azimuth | null;
}

export interface Moves {
  count: number;
  position: Float32Array; // 3 each, mm: where the move ends
  carriage: Float32Array; // 2 each, mm: where nozzle 0 is then
  end_s: Float32Array;
  layer: Uint32Array;
  role: Uint8Array;
  tool: Uint8Array;
  width: Uint8Array; // 0.01 mm
  height: Uint8Array; // 0.01 mm
  speed: Uint16Array; // 0.1 mm/s
  pushed: Float32Array; // mm3
  flags: Uint8Array;
  layer_z: Float32Array;
  layer_height: Float32Array;
  tool_change_move: Uint32Array;
  order: Uint32Array; // moves by layer, within a layer as in the file
  layer_start: Uint32Array; // where a layer begins in `order`; one more than layers
}

export const kinds = ["smear", "inner", "own", "hole", "wipe", "zipper"] as const;
export type Kind = (typeof kinds)[number];

export interface Places {
  count: number;
  from: Float32Array; // 3 each, mm
  to: Float32Array; // 3 each, mm
  mm3: Float32Array; // of smears, blobs and holes: as much as is to be seen of them; of inner: as much as is not
  visibility: Float32Array;
  layer: Uint32Array;
  move: Uint32Array;
  kind: Uint8Array; // index into kinds
  nozzle: Uint8Array;
  over: Uint8Array;
}

export interface Audit {
  visibility: Uint8Array; // of each move, 255 in full sight
  layer_smear: Float32Array; // mm3
  layer_hole: Float32Array; // mm3
  layer_zippers: Float32Array;
  places: Places;
  worst: number[]; // indices of places, of those close together the worst
  worst_mm3: number[]; // of all that are close together
  figures: Record<string, number>;
  ooze: OozeRate[]; // of each nozzle, as the audit assumed it; empty where it does not say
}

/** An idle nozzle carries volume_mm3 (1 - exp(-t / time_s)). */
export interface OozeRate { volume_mm3: number; time_s: number }

/** The box of the part, else of all plastic; where there is none, some place to look at. */
export const box_of = (s: Summary): Box => s.part_box_mm ?? s.box_mm ?? [[-50, -50, 0], [50, 50, 50]];

/** Where a move starts, mm: where the carriage was, with the nozzle that makes the move. Not always the end of the move
 *  before, which another nozzle may have made.  Requires: move > 0. */
export function start_of(m: Moves, move: number): [number, number] {
  const offset = (c: number) => m.position[3 * move + c]! - m.carriage[2 * move + c]!;
  return [m.carriage[2 * move - 2]! + offset(0), m.carriage[2 * move - 1]! + offset(1)];
}

/** Moves sorted by layer; stable, because prints object by object come back to low layers. */
export function by_layer(layer: Uint32Array, layers: number): { order: Uint32Array; layer_start: Uint32Array } {
  const layer_start = new Uint32Array(layers + 1);
  for (let i = 0; i < layer.length; i++) layer_start[layer[i]! + 1]!++;
  for (let l = 0; l < layers; l++) layer_start[l + 1]! += layer_start[l]!;
  const next = layer_start.slice();
  const order = new Uint32Array(layer.length);
  for (let i = 0; i < layer.length; i++) order[next[layer[i]!]!++] = i;
  return { order, layer_start };
}

export function moves_of(bytes: ArrayBuffer): Moves {
  const p = unpack(bytes);
  const layer = column(p, "layer", Uint32Array);
  const layer_z = column(p, "layer_z", Float32Array);
  return {
    count: layer.length,
    position: column(p, "position", Float32Array), carriage: column(p, "carriage", Float32Array),
    end_s: column(p, "end_s", Float32Array), layer, role: column(p, "role", Uint8Array), tool: column(p, "tool", Uint8Array),
    width: column(p, "width", Uint8Array), height: column(p, "height", Uint8Array), speed: column(p, "speed", Uint16Array),
    pushed: column(p, "pushed", Float32Array), flags: column(p, "flags", Uint8Array),
    layer_z, layer_height: column(p, "layer_height", Float32Array), tool_change_move: column(p, "tool_change_move", Uint32Array),
    ...by_layer(layer, layer_z.length),
  };
}

export function audit_of(bytes: ArrayBuffer): Audit {
  const p = unpack(bytes);
  const mm3 = column(p, "place_mm3", Float32Array);
  return {
    visibility: column(p, "visibility", Uint8Array), layer_smear: column(p, "layer_smear", Float32Array),
    layer_hole: column(p, "layer_hole", Float32Array), layer_zippers: column(p, "layer_zippers", Float32Array),
    places: {
      count: mm3.length, from: column(p, "place_from", Float32Array), to: column(p, "place_to", Float32Array), mm3,
      visibility: column(p, "place_visibility", Float32Array), layer: column(p, "place_layer", Uint32Array),
      move: column(p, "place_move", Uint32Array), kind: column(p, "place_kind", Uint8Array),
      nozzle: column(p, "place_nozzle", Uint8Array), over: column(p, "place_over", Uint8Array),
    },
    worst: p.header["worst"] as number[], worst_mm3: (p.header["worst_mm3"] as number[] | undefined) ?? [], figures: p.header["figures"] as Record<string, number>,
    ooze: (p.header["ooze"] as OozeRate[] | undefined) ?? [],
  };
}
