// The list of defects, worst first. A click takes the sliders and the camera there.
import { kinds } from "../data/print.ts";
import { css, nozzle_colours } from "../model/palette.ts";
import type { Viewer } from "../viewer.ts";
import { el, option, swatch } from "./dom.ts";
import { amount, kind_name, place_title } from "./words.ts";

const rows_shown = 200;

export function defects(viewer: Viewer): HTMLElement {
  const list = el("ol", { class: "defects", id: "defects" });
  const which = el("select", { id: "defect-side", "aria-label": "Defects of which print", change: () => fill() });
  const kind = el("select", { id: "defect-kind", "aria-label": "Kind of defect", change: () => fill() }, option("", "smears and holes"), option("smear", "smears"), option("hole", "holes"));
  const note = el("p", { class: "note" });
  const panel = el("div", { class: "pane" }, el("div", { class: "row" }, which, kind), note, list);

  function fill(): void {
    const n = Math.min(Number(which.value) || 0, viewer.sides.length - 1), side = viewer.sides[n];
    if (!side) { note.textContent = ""; list.replaceChildren(); return; }
    if (!side.audit) { note.textContent = side.trouble || "The audit is still at work."; list.replaceChildren(); return; }
    const { places, worst, worst_mm3 } = side.audit;
    const colours = nozzle_colours(side.summary.nozzles.map((z) => z.colour)).map(css);
    const chosen = worst.map((place, rank) => ({ place, mm3: worst_mm3[rank] ?? places.mm3[place]! }))
      .filter(({ place }) => !kind.value || kinds[places.kind[place]!] === kind.value);
    note.textContent = chosen.length === 0 ? "None found." : chosen.length > rows_shown ? `${amount(chosen.length)} places; the worst ${rows_shown}:` : `${chosen.length} places, the worst first`;
    list.replaceChildren(...chosen.slice(0, rows_shown).map(({ place: k, mm3 }) => {
      const title = place_title(places.kind[k]!, places.nozzle[k]!, places.over[k]!);
      const selected = viewer.selected?.side === n && viewer.selected.place === k;
      return el("li", {}, el("button", { type: "button", class: `defect ${kind_name(places.kind[k]!)}`, "aria-pressed": selected ? "true" : "false", "data-place": k, click: () => viewer.select({ side: n, place: k }) },
        swatch(colours[places.nozzle[k]!] ?? "grey"), el("span", { class: "what" }, title), el("span", { class: "amount" }, `${amount(mm3)} mm³`),
        el("span", { class: "at" }, `layer ${places.layer[k]! + 1}  ·  z ${places.to[3 * k + 2]!.toFixed(1)} mm`)));
    }));
  }

  viewer.on((what) => {
    if (what === "prints") {
      which.replaceChildren(...viewer.sides.map((s, i) => option(String(i), s.name, i === 0)));
      which.hidden = viewer.sides.length < 2;
    }
    if (what === "prints" || what === "audit") fill();
    if (what === "selection") for (const b of list.querySelectorAll("button")) {
      const on = viewer.selected?.side === (Number(which.value) || 0) && viewer.selected.place === Number(b.dataset["place"]);
      b.setAttribute("aria-pressed", on ? "true" : "false");
    }
  });
  return panel;
}
