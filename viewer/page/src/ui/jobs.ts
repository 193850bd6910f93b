// The queue of slicing jobs: progress, cancel, view, download. The server holds it, so that it survives a reload.
import { api, words_of, type Job } from "../data/api.ts";
import { el } from "./dom.ts";

const poll_ms = 400;

export interface Jobs { element: HTMLElement; watch: (id?: number) => void }

/** `done` hears of a job that was asked for here and has ended well; `view` is asked to show a print. */
export function jobs(done: (job: Job) => void, view: (print: number) => void): Jobs {
  const list = el("ul", { class: "jobs", id: "jobs", "aria-live": "polite" });
  const element = el("section", { class: "pane", "aria-label": "Jobs", hidden: true }, el("h3", {}, "Jobs"), list);
  const waited = new Set<number>();
  let polling = false, again = false;

  function row(j: Job): HTMLElement {
    const active = j.state === "running" || j.state === "queued";
    const end = el("button", { type: "button", class: "quiet small", click: () => { void api.end_job(j.id).then(() => watch()).catch(() => watch()); } }, active ? "Cancel" : "Forget");
    const bar = el("progress", { max: 1, "aria-label": `Progress of job ${j.id}` });
    if (j.state === "running") bar.value = j.progress ?? 0;
    const said = j.state === "queued" ? `waits, ${j.position ?? 0} before it` : j.state === "running" ? j.stage || "starting" : j.state === "failed" ? words_of(j.error) : j.state;
    return el("li", { class: j.state, "data-job": j.id, "data-state": j.state }, el("span", { class: "name" }, j.name ?? `job ${j.id}`), el("span", { class: "said" }, said), active ? bar : null,
      el("span", { class: "acts" }, j.print ? el("button", { type: "button", class: "small", click: () => view(j.print!) }, "View") : null,
        j.print ? el("a", { class: "button small", href: api.gcode_address(j.print), download: true }, "Download") : null, end),
      j.warnings?.length ? el("ul", { class: "warnings" }, ...j.warnings.map((w) => el("li", {}, w))) : null);
  }

  async function poll(): Promise<void> {
    again = true;
    if (polling) return;
    polling = true;
    try {
      for (;;) {
        again = false;
        const all = await api.jobs();
        element.hidden = all.length === 0;
        list.replaceChildren(...all.slice().reverse().map(row));
        for (const j of all) if (waited.has(j.id) && j.state !== "queued" && j.state !== "running") { waited.delete(j.id); if (j.state === "done") done(j); }
        if (!again && !all.some((j) => j.state === "queued" || j.state === "running")) break;
        if (!again) await new Promise((r) => setTimeout(r, poll_ms));
      }
    } catch { /* the program has ended; the next request says so */ } finally { polling = false; }
  }
  function watch(id?: number): void { if (id !== undefined) waited.add(id); void poll(); }
  return { element, watch };
}
