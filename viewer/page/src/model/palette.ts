// Colours, packed as the graphics card reads them: bytes r, g, b, a of a little-endian number.
export type Rgba = number;

export const rgba = (r: number, g: number, b: number): Rgba => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
export const red = (c: Rgba) => c & 255;
export const green = (c: Rgba) => (c >> 8) & 255;
export const blue = (c: Rgba) => (c >> 16) & 255;

export function parse_colour(text: string): Rgba {
  const m = /^#?([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})/i.exec(text);
  return m ? rgba(parseInt(m[1]!, 16), parseInt(m[2]!, 16), parseInt(m[3]!, 16)) : rgba(128, 128, 128);
}

export const css = (c: Rgba) => `rgb(${red(c)} ${green(c)} ${blue(c)})`;

export function mix(a: Rgba, b: Rgba, share: number): Rgba {
  const one = (x: number, y: number) => Math.round(x + (y - x) * share);
  return rgba(one(red(a), red(b)), one(green(a), green(b)), one(blue(a), blue(b)));
}

/** A ramp through colours at equal distances, in 256 steps. */
export function ramp(...stops: string[]): Uint32Array {
  const parsed = stops.map(parse_colour);
  return Uint32Array.from({ length: 256 }, (_, i) => {
    const at = (i / 255) * (parsed.length - 1);
    const k = Math.min(parsed.length - 2, Math.floor(at));
    return mix(parsed[k]!, parsed[k + 1]!, at - k);
  });
}

/** Viridis: even in lightness, and read by the colour-blind. */
export const viridis = ramp("#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725");
/** For damage: from barely to badly. */
export const heat = ramp("#ffd166", "#f8961e", "#ef476f", "#b5179e");

/** Two nozzles of the same colour could not be told apart: the later one takes the next of these. */
const distinct = ["#3f7fbf", "#e69f00", "#2a9d76", "#cc79a7", "#8d6cab", "#d55e00", "#56b4e9", "#b5a642"];

export function nozzle_colours(texts: string[]): Rgba[] {
  const taken: Rgba[] = [];
  const far = (c: Rgba) => taken.every((t) => Math.abs(red(t) - red(c)) + Math.abs(green(t) - green(c)) + Math.abs(blue(t) - blue(c)) > 60);
  for (const text of texts) {
    let c = parse_colour(text);
    if (!far(c)) c = distinct.map(parse_colour).find(far) ?? c;
    taken.push(c);
  }
  return taken;
}
