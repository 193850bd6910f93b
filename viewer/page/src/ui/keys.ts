// The keyboard: one table, from which the help is made too.
import { colourings } from "../model/colouring.ts";
import { steps_of } from "../model/moment.ts";
import type { Viewer } from "../viewer.ts";
import { el } from "./dom.ts";

interface Key { keys: string[]; shown: string; what: string; act: (v: Viewer, big: boolean) => void }

const table: Key[] = [
  { keys: ["ArrowUp"], shown: "↑", what: "layer up (shift: ten)", act: (v, big) => v.go({ layer: v.at.layer + (big ? 10 : 1) }) },
  { keys: ["ArrowDown"], shown: "↓", what: "layer down", act: (v, big) => v.go({ layer: v.at.layer - (big ? 10 : 1) }) },
  { keys: ["ArrowRight"], shown: "→", what: "next move (shift: hundred)", act: (v, big) => v.go({ step: v.at.step + (big ? 100 : 1) }) },
  { keys: ["ArrowLeft"], shown: "←", what: "move before", act: (v, big) => v.go({ step: v.at.step - (big ? 100 : 1) }) },
  { keys: ["Home"], shown: "Home", what: "begin of the layer", act: (v) => v.go({ step: 0 }) },
  { keys: ["End"], shown: "End", what: "end of the layer", act: (v) => { if (v.first) v.go({ step: steps_of(v.first.moves, v.at.layer) }); } },
  { keys: [" "], shown: "Space", what: "play, pause", act: (v) => v.play(!v.playing) },
  { keys: ["c"], shown: "C", what: "next colouring", act: (v) => {
    const open = colourings.filter((c) => v.first?.audit || ["extruder", "role", "speed"].includes(c));
    v.set_look({ colouring: open[(open.indexOf(v.look.colouring) + 1) % open.length]! });
  } },
  { keys: ["n"], shown: "N", what: "next defect", act: (v) => {
    const s = v.sides[v.selected?.side ?? 0], worst = s?.audit?.worst ?? [];
    const at = worst.indexOf(v.selected?.place ?? -1);
    if (worst.length) v.select({ side: v.selected?.side ?? 0, place: worst[(at + 1) % worst.length]! });
  } },
  { keys: ["t"], shown: "T", what: "travels", act: (v) => v.set_look({ travel: !v.look.travel }) },
  { keys: ["i"], shown: "I", what: "nozzles, ooze and ghosts", act: (v) => v.set_look({ idle: !v.look.idle }) },
  { keys: ["r"], shown: "R", what: "rampart cut open, whole, hidden", act: (v) => v.set_look({ rampart: ({ open: "whole", whole: "hidden", hidden: "open" } as const)[v.look.rampart] }) },
  { keys: ["h", "0"], shown: "H", what: "camera home", act: (v) => v.home() },
  { keys: ["Escape"], shown: "Esc", what: "no defect chosen", act: (v) => v.select(null) },
];

/** Listens on the page; returns the help, opened by ?. */
export function keys(viewer: Viewer): HTMLDialogElement {
  const help = el("dialog", { id: "help", "aria-label": "Keys" }, el("h2", {}, "Keys"),
    el("dl", {}, ...table.flatMap((k) => [el("dt", {}, el("kbd", {}, k.shown)), el("dd", {}, k.what)]), el("dt", {}, el("kbd", {}, "?")), el("dd", {}, "this help")),
    el("p", { class: "note" }, "Drag turns, right drag or two fingers move, the wheel zooms to the pointer."),
    el("form", { method: "dialog" }, el("button", { class: "quiet" }, "Close")));
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || help.open || document.querySelector("dialog[open]")) return;
    const on = e.target as HTMLElement;
    if (on.matches("input:not([type=range]):not([type=checkbox]), select, textarea, [contenteditable]")) return;
    if (e.key === " " && on.matches("button, summary, input[type=checkbox]")) return;
    if (on.matches("input[type=range]") && (e.key === "Home" || e.key === "End")) return;
    if (e.key.startsWith("Arrow") && on.matches("[role=tabpanel], [role=tab]")) return;
    if (e.key === "?") { help.showModal(); return; }
    const found = table.find((k) => k.keys.includes(e.key));
    if (!found) return;
    e.preventDefault();
    found.act(viewer, e.shiftKey);
  });
  return help;
}
