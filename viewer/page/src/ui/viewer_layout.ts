// The parts of the page that the program's page and the report share: the picture with its controls, and the side panes.
import { Viewer } from "../viewer.ts";
import { defects } from "./defects.ts";
import { el } from "./dom.ts";
import { figures } from "./figures.ts";
import { keys } from "./keys.ts";
import { layer_bar } from "./layer_bar.ts";
import { look_panel } from "./look_panel.ts";
import { move_bar } from "./move_bar.ts";
import { tabs, type Tabs } from "./tabs.ts";

export interface Layout { viewer: Viewer; main: HTMLElement; help: HTMLDialogElement; side: Tabs; say: (text: string, progress?: number) => void }

export function viewer_layout(more: { name: string; title: string; content: HTMLElement }[]): Layout {
  const canvas = el("canvas", { class: "picture", tabindex: 0, role: "img", "aria-label": "The print in three dimensions" });
  const viewer = new Viewer(canvas);
  const names = el("div", { class: "names", "aria-hidden": "true" });
  const words = el("span", {}), bar = el("progress", { max: 1, "aria-label": "Reading" });
  const status = el("div", { class: "status card", role: "status", hidden: true }, words, bar);
  const home = el("button", { type: "button", class: "home quiet", title: "Camera home (H)", "aria-label": "Camera home", click: () => viewer.home() }, "⌂");
  const stage = el("div", { class: "stage" }, canvas, names, look_panel(viewer), home, status);
  const side = tabs("Details", [{ name: "defects", title: "Defects", content: defects(viewer) }, { name: "figures", title: "Figures", content: figures(viewer) }, ...more]);
  const main = el("main", {}, stage, layer_bar(viewer), move_bar(viewer), el("aside", { "aria-label": "Details" }, side.element));
  viewer.on((what) => {
    if (what !== "prints") return;
    names.classList.toggle("tall", viewer.stage.tall());
    names.replaceChildren(...(viewer.sides.length > 1 ? viewer.sides.map((s) => el("span", {}, s.name)) : []));
  });
  const say = (text: string, progress?: number) => {
    status.hidden = text === "";
    words.textContent = text;
    if (progress === undefined || progress <= 0) bar.removeAttribute("value"); else bar.value = progress;
    bar.hidden = progress === undefined;
  };
  return { viewer, main, help: keys(viewer), side, say };
}
