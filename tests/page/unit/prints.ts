// Prints drawn by hand for tests: moves as lines of [x, y, z, lays, tool, layer], all known from the first on.
import { by_layer, flag, type Audit, type Moves } from "../../../viewer/page/src/data/print.ts";

export type Line = [x: number, y: number, z: number, lays: boolean, tool: number, layer: number];

export function moves_from(lines: Line[], offsets: [number, number][] = [[0, 0], [10, 0]]): Moves {
  const n = lines.length, layers = Math.max(...lines.map((l) => l[5])) + 1;
  const layer = Uint32Array.from(lines, (l) => l[5]);
  return {
    count: n, layer, position: Float32Array.from(lines.flatMap((l) => l.slice(0, 3) as number[])),
    carriage: Float32Array.from(lines.flatMap((l) => [l[0] - offsets[l[4]]![0], l[1] - offsets[l[4]]![1]])),
    end_s: Float32Array.from(lines, (_, i) => i + 1), role: new Uint8Array(n), tool: Uint8Array.from(lines, (l) => l[4]),
    width: new Uint8Array(n).fill(40), height: new Uint8Array(n).fill(20), speed: new Uint16Array(n).fill(600), pushed: new Float32Array(n),
    flags: Uint8Array.from(lines, (l, i) => (l[3] ? flag.lays | flag.outermost : 0) | (i > 0 ? flag.start_known : 0)),
    layer_z: Float32Array.from({ length: layers }, (_, l) => 0.2 * (l + 1)), layer_height: new Float32Array(layers).fill(0.2),
    tool_change_move: new Uint32Array(), ...by_layer(layer, layers),
  };
}

export function audit_with(places: { kind: number; nozzle: number; move: number; mm3: number }[], moves: number): Audit {
  const n = places.length, layer = new Uint32Array(n);
  return {
    visibility: new Uint8Array(moves), layer_smear: new Float32Array(1), layer_hole: new Float32Array(1), layer_zippers: new Float32Array(1), worst: [], worst_mm3: [], figures: {}, ooze: [],
    places: { count: n, from: new Float32Array(3 * n), to: new Float32Array(3 * n), mm3: Float32Array.from(places, (p) => p.mm3), visibility: new Float32Array(n).fill(1), layer,
      move: Uint32Array.from(places, (p) => p.move), kind: Uint8Array.from(places, (p) => p.kind), nozzle: Uint8Array.from(places, (p) => p.nozzle), over: new Uint8Array(n) },
  };
}
