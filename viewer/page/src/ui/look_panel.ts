// How the print is coloured and what is drawn beside it; and the legend.
import { audited_colouring, colouring_names, colourings, type Colouring } from "../model/colouring.ts";
import type { RampartShown } from "../draw/print_view.ts";
import type { Viewer } from "../viewer.ts";
import { el, option, swatch } from "./dom.ts";

export function look_panel(viewer: Viewer): HTMLElement {
  const colouring = el("select", { id: "colouring", "aria-label": "Colour by", change: () => viewer.set_look({ colouring: colouring.value as Colouring }) },
    ...colourings.map((c) => option(c, colouring_names[c])));
  const rampart = el("select", { id: "rampart-shown", "aria-label": "Rampart and other plastic thrown away", change: () => viewer.set_look({ rampart: rampart.value as RampartShown }) },
    option("open", "Rampart cut open", true), option("whole", "Rampart whole"), option("hidden", "Rampart hidden"));
  const idle = el("input", { type: "checkbox", id: "show-idle", checked: viewer.look.idle, change: () => viewer.set_look({ idle: idle.checked }) });
  const travel = el("input", { type: "checkbox", id: "show-travel", checked: viewer.look.travel, change: () => viewer.set_look({ travel: travel.checked }) });
  const legend = el("ul", { class: "legend", "aria-label": "Legend" });
  const panel = el("section", { class: "look-panel card", "aria-label": "Colours" }, colouring, legend,
    el("details", { class: "beside" }, el("summary", {}, "Show"), rampart,
      el("label", { class: "check" }, idle, "Nozzles, ooze and ghosts"), el("label", { class: "check" }, travel, "Travels of the layer")));

  viewer.on((what) => {
    if (what === "moment" || what === "play") return;
    for (const o of colouring.options) o.disabled = audited_colouring(o.value as Colouring) && !viewer.first?.audit;
    colouring.value = viewer.look.colouring;
    rampart.value = viewer.look.rampart;
    idle.checked = viewer.look.idle;
    travel.checked = viewer.look.travel;
    const shown = viewer.first?.view.legend;
    if (!shown) return;
    legend.replaceChildren(...shown.entries.map((e) => el("li", {}, e.colour ? swatch(e.colour) : null, e.label)));
    if (shown.scale) {
      const strip = el("span", { class: "ramp", "aria-hidden": "true" });
      strip.style.background = `linear-gradient(to right, ${shown.scale.ramp.join(", ")})`;
      legend.append(el("li", { class: "scale" }, el("span", {}, shown.scale.from), strip, el("span", {}, shown.scale.to)));
    }
  });
  return panel;
}
