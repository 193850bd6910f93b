// The page of `cleancolor view`: prints of the server, files opened here, slicing.
import "./style.css";
import { api, can_be_shown, pause, ServerSource, type PrintState } from "./data/api.ts";
import { set_test_hooks } from "./test_hooks.ts";
import { el, option } from "./ui/dom.ts";
import { jobs } from "./ui/jobs.ts";
import { opener, type Opened } from "./ui/open.ts";
import { slicing } from "./ui/slicing.ts";
import { unread } from "./ui/unread.ts";
import { viewer_layout } from "./ui/viewer_layout.ts";

let prints: PrintState[] = [];
let shown: number[] = []; // ids of the prints shown, or about to be

const open = opener((files) => void take(files));
const slice_panel = slicing(open.pick, (id) => job_list.watch(id));
const job_list = jobs((job) => { if (job.print) void show_print(job.print); }, (print) => void show_print(print));
const { viewer, main, help, side, say } = viewer_layout([{ name: "slice", title: "Slice", content: el("div", {}, slice_panel.element, job_list.element) }]);
set_test_hooks(viewer);

const first = el("select", { id: "print", "aria-label": "Print", change: () => void show([Number(first.value), ...shown.slice(1)]) });
const second = el("select", { id: "compare", "aria-label": "Compare with", change: () => void show(second.value ? [shown[0]!, Number(second.value)] : [shown[0]!]) });
const download = el("a", { class: "button", id: "download", download: true, title: "Download this G-code", hidden: true }, "Download");
const forget = el("button", { type: "button", class: "quiet", id: "forget", title: "Have the program drop this print", hidden: true, click: () => void forget_shown() }, "Forget");
const bad = unread((print) => drop(print).then(() => say("")).catch(fail));
const welcome = el("div", { class: "welcome", hidden: true }, el("h2", {}, "See how clean it comes out"),
  el("p", {}, "Drop the G-code of any slicer here to see where idle nozzles leave ooze, or meshes to slice them clean."), el("button", { type: "button", class: "primary", click: open.pick }, "Open files…"));
main.querySelector(".stage")!.append(welcome);
document.getElementById("page")!.append(
  el("header", {}, el("h1", {}, el("span", { class: "logo", "aria-hidden": "true" }, el("i"), el("i"), el("i")), "cleancolor"), first, forget, second,
    el("span", { class: "gap" }), download, el("button", { type: "button", id: "open", click: open.pick }, "Open…"), el("button", { type: "button", class: "quiet", id: "show-help", "aria-label": "Keys and help", title: "Keys (?)", click: () => help.showModal() }, "?")),
  bad.element, main, help, open.input, open.curtain);

function fill_prints(): void {
  const here = prints.filter(can_be_shown);
  first.replaceChildren(...here.map((p) => option(String(p.id), p.name, p.id === shown[0])));
  first.selectedIndex = here.findIndex((p) => p.id === shown[0]);
  second.replaceChildren(option("", "compare with…", shown.length < 2), ...here.filter((p) => p.id !== shown[0]).map((p) => option(String(p.id), p.name, p.id === shown[1])));
  first.hidden = here.length === 0;
  second.hidden = here.length < 2;
  download.hidden = forget.hidden = shown.length === 0;
  if (shown.length) download.href = api.gcode_address(shown[0]!);
  welcome.hidden = shown.length > 0;
  bad.show(prints.filter((p) => !can_be_shown(p)));
  void watch_prints();
}

let watching = false;
const most_misses = 5; // requests that fail one after the other until it gives up
/** Which prints there are, and which can be shown. */
const known = (all: PrintState[]) => all.map((p) => `${p.id} ${can_be_shown(p)}`).join();
/** Asks again until all prints are read: some may turn out to be unreadable. */
async function watch_prints(): Promise<void> {
  if (watching) return;
  watching = true;
  for (let misses = 0; misses < most_misses && prints.some((p) => p.state === "reading");) {
    await pause(400 * 2 ** misses);
    const before = prints, now = await api.prints().catch(() => null);
    if (!now) { misses++; continue; } // if the program has ended, the next request says so
    misses = 0;
    if (prints !== before) continue; // somebody knows better
    prints = now;
    if (known(before) !== known(now)) fill_prints();
  }
  watching = false;
}

function fail(e: unknown): void { say(e instanceof Error ? e.message : String(e)); }

viewer.on((what) => { if (what === "prints") look_again(); });
/** Sets what the page says is shown to what the viewer shows: of the prints asked for, some may be unreadable. */
function look_again(): void {
  shown = viewer.sides.map((s) => (s.source as ServerSource).id);
  fill_prints();
}

async function show(ids: number[]): Promise<void> {
  shown = ids.filter((id, i) => prints.some((p) => p.id === id) && ids.indexOf(id) === i);
  fill_prints();
  try {
    await viewer.open(shown.map((id) => ({ name: prints.find((p) => p.id === id)!.name, source: new ServerSource(id) })), say);
  } catch (e) {
    fail(e);
    look_again();
  }
}

async function show_print(id: number): Promise<void> {
  try { prints = await api.prints(); } catch (e) { fail(e); return; }
  await show([id]);
}

/** Has the program drop a print, and the job that made it. */
async function drop(print: PrintState): Promise<void> {
  await api.forget_print(print.id);
  for (const job of await api.jobs()) if (job.print === print.id) await api.end_job(job.id);
  prints = await api.prints();
  fill_prints();
  job_list.watch();
}

/** Drops the first print, and shows the one compared with, else the newest. */
async function forget_shown(): Promise<void> {
  const print = prints.find((p) => p.id === shown[0]);
  if (!print || !confirm(`Forget ${print.name}? What was sliced here is gone, unless you have downloaded it.`)) return;
  try { await drop(print); } catch (e) { fail(e); return; }
  const next = shown[1] ?? prints.filter(can_be_shown).at(-1)?.id;
  say("");
  await show(next === undefined ? [] : [next]);
}

async function take({ gcode, mesh, printer, unknown }: Opened): Promise<void> {
  try {
    if (printer.length) { side.show("slice"); await slice_panel.add_printers(printer); }
    for (const file of mesh) {
      say(`uploading ${file.name}`, 0);
      const { id } = await api.add_mesh(file);
      slice_panel.add_mesh({ id, name: file.name, bytes: file.size });
      side.show("slice");
    }
    const ids: number[] = [];
    for (const file of gcode) { say(`uploading ${file.name}`, 0); ids.push((await api.add_print(file)).id); }
    say("");
    if (ids.length) { prints = await api.prints(); await show(ids.slice(0, 2)); }
    if (unknown.length) say(`${unknown[0]!.name}: neither G-code nor a mesh (STL, OBJ, PLY, AMF, 3MF), nor a printer's profile (.toml)`);
  } catch (e) { fail(e); }
}

try {
  prints = await api.prints();
  job_list.watch();
  fill_prints();
  const good = prints.filter(can_be_shown);
  if (good.length) await show(good.slice(0, 2).map((p) => p.id));
  else if ((await api.meshes()).length) side.show("slice");
} catch (e) { fail(e); }
