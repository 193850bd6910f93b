// What the slicing panel knows without a page: which options matter, what holds where nothing is changed, the request.
import type { JobRequest, Option, Profile } from "../data/api.ts";

/** Shown at once; all others are under "All options". */
export const options_that_matter = ["layer_height", "perimeters", "fill_density", "fill_pattern", "rampart", "planner", "effort", "seam_position", "brim_width", "skirts"];

/** Beside them, though it is no option of the table: by how much the parts are turned. */
export const azimuth_option: Option = {
  name: "azimuth", group: "print", section: "", unit: "", kind: "text", per_extruder: false, default: "auto",
  help: "auto: so that idle nozzles hover least over another colour; off; or by so many degrees",
};

export interface Choice {
  printer: string; print: string; materials: string[]; protect: string;
  azimuth: string; // "": as the protection says
  meshes: { id: number; wanted: number }[]; // the extruder wanted, from 0, which the printer may not have: extruder_of
  changed: Map<string, string>; // options the person has set
}

const profile = (all: Profile[], group: Profile["group"], name: string | undefined) => all.find((p) => p.group === group && p.name === name);

/** How the parts are turned where nothing is set. */
export const standing_azimuth = (profiles: Profile[], choice: Choice) => ((profile(profiles, "protection", choice.protect)?.turns ?? choice.protect !== "none") ? "auto" : "off");

/** The text that holds where nothing is set: of the level of protection, else the print settings, else the material, else
 *  the printer, else the default. */
export function standing_value(option: Option, profiles: Profile[], choice: Choice): string {
  for (const p of [profile(profiles, "protection", choice.protect), profile(profiles, "print", choice.print), profile(profiles, "material", choice.materials[0]), profile(profiles, "printer", choice.printer)]) {
    const text = p?.settings[option.name];
    if (text !== undefined) return text;
  }
  return option.default;
}

export function extruders_of(profiles: Profile[], printer: string): number {
  return Math.max(1, profile(profiles, "printer", printer)?.extruders ?? 1);
}

/** Whether a profile was sent to the program, and can be forgotten: not built in, nor that of the command line. */
export const was_sent = (p: Profile) => p.group === "printer" && !p.chosen && p.name.endsWith(".toml");

/** The printer's own materials and print settings: what changes when another printer is chosen. Which extruder a part is
 *  wanted of does not, so that choosing the printer before brings it back. */
export function with_printer(choice: Choice, profiles: Profile[], printer: string): Choice {
  const p = profile(profiles, "printer", printer), n = extruders_of(profiles, printer);
  const material = p?.default_material || profiles.find((q) => q.group === "material")?.name || "";
  return { ...choice, printer, print: p?.default_print || choice.print, materials: Array.from({ length: n }, () => material) };
}

/** The extruder that prints a part: the one wanted, else the printer's last. */
export const extruder_of = (mesh: { wanted: number }, choice: Choice) => Math.min(mesh.wanted, Math.max(1, choice.materials.length) - 1);

export function job_request(choice: Choice): JobRequest {
  const azimuth = choice.azimuth ? { azimuth: choice.azimuth } : {};
  const meshes = choice.meshes.map((m) => ({ id: m.id, extruder: extruder_of(m, choice) }));
  return { meshes, printer: choice.printer, materials: choice.materials, print: choice.print, protect: choice.protect, ...azimuth, settings: Object.fromEntries(choice.changed) };
}

/** Words of a search, each of which must occur in name, help or section. */
export function found(option: Option, search: string): boolean {
  const text = `${option.name} ${option.name.replace(/_/g, " ")} ${option.help} ${option.section}`.toLowerCase();
  return search.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}

export const title_of = (name: string) => { const t = name.replace(/_/g, " "); return t[0]!.toUpperCase() + t.slice(1); };

export type FileKind = "mesh" | "gcode" | "printer" | "unknown";
const endings: [FileKind, RegExp][] = [["mesh", /\.(stl|obj|3mf|amf|ply)$/i], ["gcode", /\.(gcode|gco|g|nc|ngc|txt)$/i], ["printer", /\.toml$/i]];
export const kind_of_file = (name: string): FileKind => endings.find(([, ending]) => ending.test(name))?.[0] ?? "unknown";
