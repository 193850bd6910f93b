// The server's binary answers: a header in JSON, then arrays (docs/viewer-api.md). The arrays are views of the answer,
// nothing is copied.

export type Column = Float32Array | Uint32Array | Uint16Array | Uint8Array;
interface Description { type: "f32" | "u32" | "u16" | "u8"; components: number; count: number; offset: number }
export interface Packed { header: Record<string, unknown>; columns: Record<string, Column> }

const makers = {
  f32: (b: ArrayBuffer, at: number, n: number) => new Float32Array(b, at, n),
  u32: (b: ArrayBuffer, at: number, n: number) => new Uint32Array(b, at, n),
  u16: (b: ArrayBuffer, at: number, n: number) => new Uint16Array(b, at, n),
  u8: (b: ArrayBuffer, at: number, n: number) => new Uint8Array(b, at, n),
};

/** Throws where the bytes are not such an answer. */
export function unpack(bytes: ArrayBuffer): Packed {
  const magic = new TextDecoder("latin1").decode(bytes.slice(0, 8));
  if (magic !== "CCARRAY1") throw new Error("this is not data of a print: it does not begin with CCARRAY1");
  const length = new DataView(bytes).getUint32(8, true);
  const base = 12 + length;
  if (base > bytes.byteLength) throw new Error("data of a print ends within its header");
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 12, length))) as { arrays: Record<string, Description> };
  const columns: Record<string, Column> = {};
  for (const [name, d] of Object.entries(header.arrays)) {
    columns[name] = makers[d.type](bytes, base + d.offset, d.components * d.count);
  }
  return { header: header as unknown as Record<string, unknown>, columns };
}

/** A column that must be there, of this kind. */
export function column<T extends Column>(packed: Packed, name: string, kind: { new (...args: never[]): T }): T {
  const c = packed.columns[name];
  if (!(c instanceof kind)) throw new Error(`data of a print lack '${name}'`);
  return c;
}
