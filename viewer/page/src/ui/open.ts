// Opening files: by the file dialog or dropped anywhere on the page.
import { kind_of_file, type FileKind } from "../model/slicing.ts";
import { el } from "./dom.ts";

export interface Opener { input: HTMLInputElement; curtain: HTMLElement; pick: () => void }

export type Opened = Record<FileKind, File[]>;

export function opener(opened: (files: Opened) => void): Opener {
  const sort = (files: File[]) => {
    const sorted: Opened = { mesh: [], gcode: [], printer: [], unknown: [] };
    for (const f of files) sorted[kind_of_file(f.name)].push(f);
    opened(sorted);
  };
  const input = el("input", { type: "file", multiple: true, id: "file", class: "unseen", tabindex: -1, "aria-label": "Files to open", accept: ".gcode,.gco,.g,.nc,.stl,.obj,.3mf,.amf,.ply,.toml" });
  input.addEventListener("change", () => { sort([...(input.files ?? [])]); input.value = ""; });
  const curtain = el("div", { class: "curtain", hidden: true }, el("p", {}, "Drop G-code to look at it, meshes to slice them"));
  let depth = 0;
  const files = (e: DragEvent) => e.dataTransfer?.types.includes("Files") ?? false;
  document.addEventListener("dragenter", (e) => { if (files(e)) { depth++; curtain.hidden = false; } });
  document.addEventListener("dragleave", (e) => { if (files(e) && --depth <= 0) { depth = 0; curtain.hidden = true; } });
  document.addEventListener("dragover", (e) => { if (files(e)) e.preventDefault(); });
  document.addEventListener("drop", (e) => { depth = 0; curtain.hidden = true; if (files(e)) { e.preventDefault(); sort([...e.dataTransfer!.files]); } });
  return { input, curtain, pick: () => input.click() };
}
