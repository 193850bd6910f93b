// The queue of slicing jobs: progress, cancel, view, download. The server holds it, so that it survives a reload.
import { api, words_of, type Job } from "../data/api.ts";
import { el } from "./dom.ts";

const poll_ms = 400;

export interface Jobs { element: HTMLElement; watch: (id?: number) => void }
interface Row { element: HTMLElement; show: (job: Job) => void }

const active = (j: Job) => j.state === "running" || j.state === "queued";

/** Sets a text only where it differs: what has not changed is not read out again. */
function set_text(e: HTMLElement, text: string): void { if (e.textContent !== text) e.textContent = text; }

/** One job; stays the same element while the job changes, so that focus and clicks under way are kept. */
function job_row(id: number, end: () => void, view: (print: number) => void): Row {
  let print = 0;
  const name = el("span", { class: "name" });
  const state = el("span", { class: "said", "aria-live": "polite" }), stage = el("span", { class: "said" });
  const bar = el("progress", { max: 1, "aria-label": `Progress of job ${id}` });
  const show_it = el("button", { type: "button", class: "small", click: () => view(print) }, "View");
  const download = el("a", { class: "button small", download: true }, "Download");
  const end_it = el("button", { type: "button", class: "quiet small", click: end });
  const warnings = el("ul", { class: "warnings" });
  const element = el("li", { "data-job": id }, name, el("span", {}, state, " ", stage), bar, el("span", { class: "acts" }, show_it, download, end_it), warnings);
  return {
    element,
    show(j) {
      element.className = element.dataset["state"] = j.state;
      set_text(name, j.name ?? `job ${j.id}`);
      set_text(state, j.state === "queued" ? "waits" : j.state === "failed" ? words_of(j.error) : j.state);
      set_text(stage, j.state === "queued" ? `${j.position ?? 0} before it` : j.state === "running" ? (j.stage ?? "") : "");
      bar.hidden = !active(j);
      if (j.state === "running") bar.value = j.progress ?? 0; else bar.removeAttribute("value");
      show_it.hidden = download.hidden = !j.print;
      print = j.print ?? 0;
      if (print) download.href = api.gcode_address(print);
      set_text(end_it, active(j) ? "Cancel" : "Forget");
      warnings.hidden = !j.warnings?.length;
      if (warnings.children.length !== (j.warnings?.length ?? 0)) warnings.replaceChildren(...(j.warnings ?? []).map((w) => el("li", {}, w)));
    },
  };
}

/** `done` hears of a job that was asked for here and has ended well; `view` is asked to show a print. */
export function jobs(done: (job: Job) => void, view: (print: number) => void): Jobs {
  const list = el("ul", { class: "jobs", id: "jobs" });
  const element = el("section", { class: "pane", "aria-label": "Jobs", hidden: true }, el("h3", {}, "Jobs"), list);
  const rows = new Map<number, Row>();
  const waited = new Set<number>();
  let polling = false, again = false;

  /** The newest job stands first. */
  function show(all: Job[]): void {
    element.hidden = all.length === 0;
    for (const [id, row] of rows) if (!all.some((j) => j.id === id)) remove(id, row);
    for (const j of all) {
      let row = rows.get(j.id);
      if (!row) {
        row = job_row(j.id, () => { void api.end_job(j.id).catch(() => undefined).then(() => watch()); }, view);
        rows.set(j.id, row);
        list.prepend(row.element);
      }
      row.show(j);
    }
  }

  /** The focus goes on to the row beside. */
  function remove(id: number, { element: e }: Row): void {
    const beside = e.contains(document.activeElement) ? (e.nextElementSibling ?? e.previousElementSibling) : null;
    rows.delete(id);
    e.remove();
    beside?.querySelector<HTMLElement>(".acts button:last-child")?.focus();
  }

  async function poll(): Promise<void> {
    again = true;
    if (polling) return;
    polling = true;
    try {
      for (;;) {
        again = false;
        const all = await api.jobs();
        show(all);
        for (const j of all) if (waited.has(j.id) && !active(j)) { waited.delete(j.id); if (j.state === "done") done(j); }
        if (!again && !all.some(active)) break;
        if (!again) await new Promise((r) => setTimeout(r, poll_ms));
      }
    } catch { /* the program has ended; the next request says so */ } finally { polling = false; }
  }
  function watch(id?: number): void { if (id !== undefined) waited.add(id); void poll(); }
  return { element, watch };
}
