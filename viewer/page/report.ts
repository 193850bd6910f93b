// The report: the page's viewer over prints that stand in the same file (src/data/embedded.ts). It is drawn into the
// element with the id "cleancolor-report".
import "./src/style.css";
import { EmbeddedSource } from "./src/data/embedded.ts";
import { set_test_hooks } from "./src/test_hooks.ts";
import { viewer_layout } from "./src/ui/viewer_layout.ts";

function start(): void {
  const page = document.getElementById("cleancolor-report");
  if (!page) return;
  let layout;
  try { layout = viewer_layout([]); } catch {
    page.textContent = "This browser does not draw in three dimensions (WebGL).";
    return;
  }
  const { viewer, main, help, say } = layout;
  page.classList.add("report");
  page.append(main, help);
  set_test_hooks(viewer);
  // The wheel scrolls the report, until somebody has clicked into the picture.
  page.addEventListener("wheel", (e) => {
    const on = e.target as HTMLElement;
    if (on.classList.contains("picture") && on !== document.activeElement && !e.ctrlKey) e.stopPropagation();
  }, { capture: true });
  const names = (page.dataset["names"] ?? "").split("\n");
  const sources = Array.from({ length: EmbeddedSource.count() }, (_, n) => ({ name: names[n] || `print ${n + 1}`, source: new EmbeddedSource(n) }));
  viewer.open(sources, say).catch((e: unknown) => say(e instanceof Error ? e.message : String(e)));
}
if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start); else start();
