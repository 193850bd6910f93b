// Tabs as the accessibility practices describe them: arrows go from tab to tab, one panel is shown.
import { el } from "./dom.ts";

export interface Tabs { element: HTMLElement; show: (name: string) => void }

export function tabs(label: string, panes: { name: string; title: string; content: HTMLElement }[]): Tabs {
  const buttons = panes.map((p) => el("button", { type: "button", role: "tab", id: `tab-${p.name}`, "aria-controls": `pane-${p.name}`, click: () => show(p.name) }, p.title));
  const panels = panes.map((p) => el("div", { role: "tabpanel", id: `pane-${p.name}`, "aria-labelledby": `tab-${p.name}`, tabindex: 0 }, p.content));
  const list = el("div", { role: "tablist", "aria-label": label }, ...buttons);
  list.addEventListener("keydown", (e) => {
    const by = e.key === "ArrowRight" ? 1 : e.key === "ArrowLeft" ? -1 : 0;
    if (!by) return;
    e.stopPropagation();
    const at = buttons.findIndex((b) => b.getAttribute("aria-selected") === "true");
    const next = panes[(at + by + panes.length) % panes.length]!;
    show(next.name);
    document.getElementById(`tab-${next.name}`)?.focus();
  });
  function show(name: string): void {
    panes.forEach((p, i) => {
      const on = p.name === name;
      buttons[i]!.setAttribute("aria-selected", String(on));
      buttons[i]!.tabIndex = on ? 0 : -1;
      panels[i]!.hidden = !on;
    });
  }
  show(panes[0]!.name);
  return { element: el("div", { class: "tabs" }, list, ...panels), show };
}
