// The way through a layer: play, a slider over its moves, and what happens there: time, role, what each nozzle carries.
import { flag } from "../data/print.ts";
import { move_at, steps_of } from "../model/moment.ts";
import { css, nozzle_colours } from "../model/palette.ts";
import type { Viewer } from "../viewer.ts";
import { el, option, swatch } from "./dom.ts";
import { amount, duration } from "./words.ts";

export function move_bar(viewer: Viewer): HTMLElement {
  const play = el("button", { type: "button", class: "play", id: "play", "aria-label": "Play", title: "Play or pause (space)", click: () => viewer.play(!viewer.playing) }, "▶");
  const speed = el("select", { id: "play-speed", "aria-label": "Speed of play", title: "Speed of play", change: () => { viewer.speed = Number(speed.value); } },
    ...[1, 5, 20, 100, 500, 2000].map((s) => option(String(s), `${s}×`, s === viewer.speed)));
  const slider = el("input", { type: "range", min: 0, value: 0, id: "move", "aria-label": "Move within the layer", input: () => viewer.go({ step: Number(slider.value) }) });
  const where = el("output", { class: "where", for: "move" });
  const carried = el("div", { class: "carried", "aria-label": "What each nozzle carries" });
  const bar = el("section", { class: "move-bar", "aria-label": "Moves" }, el("div", { class: "move-row" }, play, speed, slider), el("div", { class: "move-row texts" }, where, carried));

  const sync = () => {
    const side = viewer.first;
    if (!side) { where.textContent = ""; carried.replaceChildren(); return; }
    const { moves, summary, view } = side, all = steps_of(moves, viewer.at.layer), move = move_at(moves, viewer.at);
    slider.max = String(all);
    slider.value = String(viewer.at.step);
    slider.setAttribute("aria-valuetext", `move ${viewer.at.step} of ${all}`);
    play.textContent = viewer.playing ? "❚❚" : "▶";
    play.setAttribute("aria-label", viewer.playing ? "Pause" : "Play");
    const lays = (moves.flags[move]! & flag.lays) !== 0;
    where.textContent = [`z ${moves.layer_z[viewer.at.layer]!.toFixed(2)} mm`, `move ${viewer.at.step} / ${all}`, duration(viewer.time_s()),
      `extruder ${moves.tool[move]! + 1}`, lays ? summary.roles[moves.role[move]!]!.replace(/_/g, " ") : "travel", `${Math.round(moves.speed[move]! / 10)} mm/s`].join("  ·  ");
    const colours = nozzle_colours(summary.nozzles.map((n) => n.colour));
    carried.replaceChildren(...summary.nozzles.map((_, i) => el("span", { title: `Nozzle ${i + 1} carries ${amount(view.idle.carried_mm3[i] ?? 0)} mm³ of ooze` }, swatch(css(colours[i]!)), `${(view.idle.carried_mm3[i] ?? 0).toFixed(2)} mm³`)));
  };
  let asked = false;
  viewer.on(() => { if (!asked) { asked = true; requestAnimationFrame(() => { asked = false; sync(); }); } });
  return bar;
}
