// The slicing panel: parts, printer, materials, options, and the button. What the server refuses is shown at its field.
import { api, Refusal, type Mesh, type Option, type Profile } from "../data/api.ts";
import { azimuth_option, extruder_of, extruders_of, found, job_request, options_that_matter, standing_azimuth, standing_value, was_sent, with_printer, type Choice } from "../model/slicing.ts";
import { el, field, option as choice_of } from "./dom.ts";
import { option_field, type OptionField } from "./option_field.ts";
import { amount, named } from "./words.ts";

export interface Slicing {
  element: HTMLElement;
  add_mesh: (mesh: Mesh) => void;
  /** Takes printers' profiles and chooses the last that is sound; what is wrong with others is told at the printer. */
  add_printers: (files: File[]) => Promise<void>;
}

const text_of = (e: unknown) => (e instanceof Error ? e.message : String(e));
const protections: [string, string][] = [["full", "full: azimuth, rampart, planner"], ["rampart", "azimuth and rampart"], ["none", "none"]];

export function slicing(pick: () => void, started: (id: number) => void): Slicing {
  let options: Option[] = [], profiles: Profile[] = [], meshes: Mesh[] = [];
  let choice: Choice = { printer: "", print: "", materials: [], protect: "full", azimuth: "", meshes: [], changed: new Map() };
  const fields = new Map<string, OptionField[]>();

  const parts = el("ul", { class: "parts" });
  const printer = el("select", { id: "printer", "aria-describedby": "printer-error", change: () => { complain_of_printer(""); choice = with_printer(choice, profiles, printer.value); refresh(); } });
  const printer_error = el("small", { class: "error", id: "printer-error", role: "alert", hidden: true });
  const own_printers = el("ul", { class: "parts", id: "own-printers", "aria-label": "Printers added", hidden: true });
  const add_own = el("button", { type: "button", class: "quiet", id: "add-printer", title: "A printer of your own: its profile, a .toml file", click: pick }, "Add a printer (.toml)…");
  const print = el("select", { id: "print-settings", change: () => { choice.print = print.value; refresh(); } });
  const protect = el("select", { id: "protect", change: () => { choice.protect = protect.value; refresh(); } }, ...protections.map(([v, t]) => choice_of(v, t)));
  const materials = el("div", { class: "materials" });
  const few = el("div", { class: "options" });
  const search = el("input", { type: "search", id: "option-search", placeholder: "Search", "aria-label": "Search all options", input: () => filter() });
  const all = el("div", { class: "all-options" });
  const error = el("p", { class: "error", role: "alert", hidden: true, id: "slice-error" });
  const go = el("button", { type: "submit", class: "primary", id: "slice" }, "Slice");
  const form = el("form", { class: "pane slicing", submit: (e: Event) => { e.preventDefault(); void slice(); } },
    el("h3", {}, "Parts"), parts, el("button", { type: "button", class: "quiet", id: "add-parts", click: pick }, "Add meshes…"),
    el("div", { class: "grid2" }, field("Printer", printer), field("Print settings", print)), printer_error, own_printers, add_own, materials, field("Protection of colours", protect),
    el("h3", {}, "Options"), few, el("details", { id: "all-options" }, el("summary", {}, "All options"), search, all), error, go);

  function complain_of_printer(message: string): void {
    printer_error.textContent = message;
    printer_error.hidden = message === "";
    if (message) { printer.setAttribute("aria-invalid", "true"); printer.focus(); } else printer.removeAttribute("aria-invalid");
  }

  function complain(e: unknown): void {
    const refusal = e instanceof Refusal ? e : new Refusal(String(e), 0);
    const at = refusal.field ? fields.get(refusal.field) : undefined;
    if (at) {
      if (![azimuth_option.name, ...options_that_matter].includes(refusal.field!)) document.getElementById("all-options")!.setAttribute("open", "");
      at[0]!.complain(refusal.message);
    }
    if (refusal.field === "printer") complain_of_printer(refusal.message);
    const control = { print, protect }[refusal.field ?? ""];
    control?.setAttribute("aria-invalid", "true");
    const told = at !== undefined || refusal.field === "printer";
    error.textContent = told ? "" : refusal.message;
    error.hidden = told;
  }

  async function slice(): Promise<void> {
    error.hidden = true;
    for (const f of fields.values()) f.forEach((one) => one.complain(""));
    complain_of_printer("");
    for (const c of [print, protect]) c.removeAttribute("aria-invalid");
    if (choice.meshes.length === 0) { complain(new Refusal("Add the meshes to print first.", 0)); return; }
    go.disabled = true;
    try { started((await api.slice(job_request(choice))).id); } catch (e) { complain(e); } finally { go.disabled = false; }
  }

  function add_option(o: Option, to: HTMLElement, prefix: string): HTMLElement {
    const one = option_field(o, prefix, (text) => {
      if (text === undefined) choice.changed.delete(o.name); else choice.changed.set(o.name, text);
      refresh();
    });
    fields.set(o.name, [...(fields.get(o.name) ?? []), one]);
    to.append(one.element);
    return one.element;
  }

  function filter(): void {
    for (const section of all.querySelectorAll<HTMLElement>("section")) {
      let any = false;
      for (const e of section.querySelectorAll<HTMLElement>(".option")) {
        e.hidden = !found(options.find((o) => o.name === e.dataset["name"])!, search.value);
        any ||= !e.hidden;
      }
      section.hidden = !any;
    }
  }

  function refresh(): void {
    const n = extruders_of(profiles, choice.printer);
    printer.value = choice.printer;
    print.value = choice.print;
    materials.replaceChildren(...choice.materials.map((m, i) => {
      const select = el("select", { id: `material-${i + 1}`, change: () => { choice.materials[i] = select.value; refresh(); } }, ...profiles.filter((p) => p.group === "material").map((p) => choice_of(p.name, p.name, p.name === m)));
      return field(`Material ${i + 1}`, select);
    }));
    parts.replaceChildren(...choice.meshes.map((m) => {
      const mesh = meshes.find((x) => x.id === m.id);
      const extruder = el("select", { "aria-label": `Extruder of ${mesh?.name}`, change: () => { m.wanted = Number(extruder.value); } }, ...Array.from({ length: n }, (_, i) => choice_of(String(i), `extruder ${i + 1}`, i === extruder_of(m, choice))));
      const remove = el("button", { type: "button", class: "quiet small", "aria-label": `Remove ${mesh?.name}`, click: () => { choice.meshes = choice.meshes.filter((x) => x !== m); void api.forget_mesh(m.id).catch(() => undefined); refresh(); } }, "×");
      return el("li", {}, el("span", { class: "name", title: mesh ? `${amount(mesh.bytes / 1000)} kB` : undefined }, mesh?.name ?? `mesh ${m.id}`), extruder, remove);
    }));
    fields.get(azimuth_option.name)?.forEach((f) => f.show(choice.azimuth || undefined, standing_azimuth(profiles, choice)));
    for (const o of options) fields.get(o.name)?.forEach((f) => f.show(choice.changed.get(o.name), standing_value(o, profiles, choice)));
  }

  const printers = () => profiles.filter((p) => p.group === "printer" && !p.audit_only);

  /** Fills the lists of printers, and chooses one where the one chosen is gone. */
  function take_profiles(got: Profile[]): void {
    profiles = got;
    const all_printers = printers(), own = profiles.filter(was_sent);
    printer.replaceChildren(...all_printers.map((p) => choice_of(p.name, p.name)));
    own_printers.replaceChildren(...own.map((p) => el("li", {}, el("span", { class: "name", title: p.name }, p.name), p.audit_only ? el("small", {}, "only to audit") : null,
      el("button", { type: "button", class: "quiet small", "aria-label": `Remove ${p.name}`, title: "Have the program forget this printer", click: (e: Event) => void forget_printer(p.name, e.currentTarget as HTMLButtonElement) }, "×"))));
    own_printers.hidden = own.length === 0;
    if (all_printers.some((p) => p.name === choice.printer)) return;
    const start = all_printers.find((p) => p.chosen) ?? all_printers.find((p) => p.name === "replicator-dual") ?? all_printers.find((p) => (p.extruders ?? 1) > 1) ?? all_printers[0];
    if (start) choice = with_printer(choice, profiles, start.name);
  }

  async function load(): Promise<void> {
    const [got_options, got_profiles, got_meshes] = await Promise.all([api.options(), api.profiles(), api.meshes()]);
    options = got_options;
    print.replaceChildren(...got_profiles.filter((p) => p.group === "print").map((p) => choice_of(p.name, p.name)));
    take_profiles(got_profiles);
    for (const name of options_that_matter) { const o = options.find((x) => x.name === name); if (o) add_option(o, few, "option"); }
    const azimuth = option_field(azimuth_option, "option", (text) => { choice.azimuth = text ?? ""; refresh(); });
    fields.set(azimuth_option.name, [azimuth]);
    few.prepend(azimuth.element);
    const sections = new Map<string, HTMLElement>();
    for (const o of options) {
      const key = `${o.group}: ${o.section}`;
      if (!sections.has(key)) { const s = el("section", {}, el("h4", {}, `${o.section} (${o.group})`)); sections.set(key, s); all.append(s); }
      add_option(o, sections.get(key)!, "all").dataset["name"] = o.name;
    }
    got_meshes.forEach(take);
    refresh();
  }

  function take(mesh: Mesh): void {
    if (meshes.some((m) => m.id === mesh.id)) return;
    meshes.push(mesh);
    choice.meshes.push({ id: mesh.id, wanted: choice.meshes.length });
  }

  async function add_printers(files: File[]): Promise<void> {
    complain_of_printer("");
    await loaded;
    const wrong: string[] = [];
    for (const file of files) {
      try { await add_printer(file); } catch (e) { wrong.push(named(file.name, text_of(e))); }
    }
    refresh();
    complain_of_printer(wrong.join("\n"));
  }

  async function add_printer(file: File): Promise<void> {
    const { name } = await api.add_printer(file);
    const got = await api.profiles(), usable = !got.find((p) => p.group === "printer" && p.name === name)?.audit_only;
    if (!usable) await api.forget_printer(name); // it would take a place that nobody sees
    take_profiles(usable ? got : await api.profiles());
    if (!usable) throw new Refusal(`${name}: this profile serves only to audit G-code`, 0, "printer");
    choice = with_printer(choice, profiles, name);
  }

  /** The focus goes on to the printer below, else to the button that adds one. */
  async function forget_printer(name: string, button: HTMLButtonElement): Promise<void> {
    const at = [...own_printers.querySelectorAll("button")].indexOf(button);
    complain_of_printer("");
    button.disabled = true;
    try {
      await api.forget_printer(name).catch((e: unknown) => { if (!(e instanceof Refusal && e.status === 404)) throw e; }); // gone already
      take_profiles(await api.profiles());
    } catch (e) {
      button.disabled = false;
      complain_of_printer(named(name, text_of(e)));
      return;
    }
    refresh();
    const left = own_printers.querySelectorAll("button");
    (left[Math.min(at, left.length - 1)] ?? add_own).focus();
  }

  const loaded = load().catch(complain);
  return { element: form, add_mesh(mesh) { take(mesh); refresh(); }, add_printers };
}
