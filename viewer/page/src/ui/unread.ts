// Prints that cannot be shown: what is wrong with each, and a button that has the program drop it, for it still takes a
// place there.
import type { PrintState } from "../data/api.ts";
import { words_of } from "../data/api.ts";
import { el } from "./dom.ts";
import { named } from "./words.ts";

export interface Unread { element: HTMLElement; show: (prints: PrintState[]) => void }

export function unread(forget: (print: PrintState) => Promise<void>): Unread {
  const element = el("ul", { class: "unread", id: "unread", "aria-label": "Prints that cannot be shown", hidden: true });
  const row = (p: PrintState) => {
    const remove = el("button", { type: "button", class: "small", "aria-label": `Remove ${p.name}`, click: () => { remove.disabled = true; void forget(p).finally(() => { remove.disabled = false; }); } }, "Remove");
    return el("li", { "data-print": p.id }, el("span", { class: "error" }, named(p.name, words_of(p.error) || "the file cannot be read")), remove);
  };
  return {
    element,
    show(prints) {
      if (prints.map((p) => p.id).join() !== [...element.children].map((e) => (e as HTMLElement).dataset["print"]).join()) {
        const focused = element.contains(document.activeElement);
        element.replaceChildren(...prints.map(row));
        if (focused) element.querySelector("button")?.focus();
      }
      element.hidden = prints.length === 0;
    },
  };
}
