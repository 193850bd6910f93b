// The figures of the audit, of one print or of several beside each other, never without time and filament.
import type { Side, Viewer } from "../viewer.ts";
import { azimuth_curve } from "./azimuth_curve.ts";
import { el } from "./dom.ts";
import { amount, duration } from "./words.ts";

interface Row { name: string; unit: string; help: string; of: (s: Side) => number | undefined; text?: (x: number) => string }
const figure = (key: string, name: string, unit: string, help: string): Row => ({ name, unit, help, of: (s) => s.audit?.figures[key] });
const sum = (s: Side, what: "part_g" | "auxiliary_g") => s.summary.nozzles.reduce((x, n) => x + (n[what] ?? 0), 0);

const clean: Row[] = [
  figure("smear_volume", "Smears", "mm³", "ooze left on visible plastic of another colour, times how visible it is"),
  figure("hole_volume", "Holes", "mm³", "plastic missing from outer walls, times how visible they are"),
  figure("zippers", "Seam ends", "", "starts and ends of extrusion on outer walls"),
  figure("zippers_visible", "Seam ends in sight", "", "the same, each as visible as it is"),
  figure("smear_exposure_travel", "Over other colours, travelling", "mm", "way of idle nozzles over visible plastic of another colour while no nozzle extrudes"),
  figure("smear_exposure_print", "Over other colours, printing", "mm", "the same while another nozzle extrudes"),
  figure("own_volume", "Blobs on own colour", "mm³", "ooze left on visible plastic of the nozzle's own colour"),
  figure("inner_volume", "Hidden smears", "mm³", "ooze left on another colour where it is hidden"),
  figure("wipes", "Wipes", "", "crossings of rampart, tower or skirt by a nozzle that carries ooze"),
  figure("refills", "Refill passes", "", "passes that push plastic beside a wall of the rampart"),
];
const cost: Row[] = [
  { name: "Time", unit: "", help: "without waiting for heaters", of: (s) => s.summary.print_time_s, text: duration },
  { name: "Plastic of the part", unit: "g", help: "", of: (s) => sum(s, "part_g") },
  { name: "Thrown away", unit: "g", help: "rampart, skirt, tower, purge", of: (s) => sum(s, "auxiliary_g") },
  { name: "Travel", unit: "m", help: "", of: (s) => s.summary.travel_mm / 1000 },
  { name: "Tool changes", unit: "", help: "", of: (s) => s.summary.tool_changes },
  { name: "Layers", unit: "", help: "", of: (s) => s.summary.layers },
  { name: "Moves", unit: "", help: "", of: (s) => s.summary.moves },
];

export function figures(viewer: Viewer): HTMLElement {
  const body = el("div", { class: "pane", id: "figures" });
  const table = (title: string, rows: Row[], sides: Side[]) => el("table", {}, el("caption", {}, title),
    sides.length > 1 ? el("thead", {}, el("tr", {}, el("th", { scope: "col" }, el("span", { class: "unseen" }, "Figure")), ...sides.map((s) => el("th", { scope: "col", title: s.name }, s.name)))) : null,
    el("tbody", {}, ...rows.map((r) => el("tr", {}, el("th", { scope: "row", title: r.help || undefined }, r.name, r.unit ? el("small", {}, ` ${r.unit}`) : null),
      ...sides.map((s) => { const x = r.of(s); return el("td", {}, x === undefined ? "…" : (r.text ?? amount)(x)); })))));
  viewer.on((what) => {
    if (what !== "prints" && what !== "audit") return;
    const { sides } = viewer;
    body.replaceChildren(table("How clean", clean, sides), table("What it costs", cost, sides));
    for (const s of sides) {
      const name = sides.length > 1 ? ` of ${s.name}` : "";
      body.append(el("table", {}, el("caption", {}, `Nozzles${name}`), el("thead", {}, el("tr", {}, ...["", "offset mm", "part g", "waste g"].map((t) => el("th", { scope: "col" }, t || el("span", { class: "unseen" }, "Nozzle"))))),
        el("tbody", {}, ...s.summary.nozzles.map((n, i) => el("tr", {}, el("th", { scope: "row" }, `${i + 1} ${n.filament}`), el("td", {}, n.offset_mm.map((x) => amount(x)).join(", ")), el("td", {}, amount(n.part_g)), el("td", {}, amount(n.auxiliary_g)))))));
      if (s.summary.azimuth) body.append(azimuth_curve(s.summary.azimuth, `Azimuth${name}`));
      if (s.summary.warnings.length) body.append(el("h3", {}, `Notes${name}`), el("ul", { class: "warnings" }, ...s.summary.warnings.map((w) => el("li", {}, w))));
    }
  });
  return body;
}
