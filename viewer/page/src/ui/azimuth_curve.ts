// For how long idle nozzles hover over another colour at each angle the print could have stood at, and the one chosen.
// Angles at which it has no room on the bed are left out, and the line is broken there.
import type { Azimuth } from "../data/print.ts";
import { curve_of } from "../model/azimuth.ts";
import { el, svg } from "./dom.ts";
import { amount } from "./words.ts";

const width = 288, height = 96, left = 6, bottom = 16, top = 14;

export function azimuth_curve(azimuth: Azimuth, title: string): HTMLElement {
  const { candidates_deg, exposure_s } = azimuth;
  const chosen_deg = azimuth.chosen_deg === null ? null : (azimuth.chosen_deg + 360) % 360;
  const curve = chosen_deg === null ? null : curve_of(azimuth, chosen_deg);
  if (chosen_deg === null || !curve) return el("p", { class: "note" }, `${title}: there is room at no angle.`);
  const { runs, first_deg: first, last_deg: last, nearest } = curve, most = Math.max(1e-9, curve.most_s);
  const x = (deg: number) => left + ((deg - first) / Math.max(1, last - first)) * (width - 2 * left);
  const y = (s: number) => top + (1 - s / most) * (height - top - bottom);
  const at = x(chosen_deg >= first && chosen_deg <= last ? chosen_deg : candidates_deg[nearest]!);
  const point = (i: number) => `${x(candidates_deg[i]!).toFixed(1)},${y(exposure_s[i]!).toFixed(1)}`;
  const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", class: "azimuth", "aria-label": `Exposure over the angle; chosen: ${amount(chosen_deg)} degrees with ${amount(exposure_s[nearest] ?? 0)} seconds` },
    svg("line", { x1: left, x2: width - left, y1: height - bottom, y2: height - bottom, class: "axis" }),
    ...runs.map((run) => svg("polyline", { points: (run.length > 1 ? run : [run[0]!, run[0]!]).map(point).join(" "), class: "curve" })),
    svg("line", { x1: at, x2: at, y1: top - 4, y2: height - bottom, class: "chosen" }),
    svg("circle", { cx: at, cy: y(exposure_s[nearest] ?? 0), r: 3.5, class: "chosen" }),
    svg("text", { x: Math.min(width - 60, Math.max(4, at + 5)), y: 11 }, `${amount(chosen_deg)}°`),
    svg("text", { x: left, y: height - 4 }, `${amount(first)}°`), svg("text", { x: width - left, y: height - 4, "text-anchor": "end" }, `${amount(last)}°`));
  return el("figure", {}, el("figcaption", {}, title, el("small", {}, " s under idle nozzles, by angle")), drawing);
}
