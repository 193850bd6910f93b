// The server's API (docs/viewer-api.md): typed requests, errors in the server's words, and a print as a Source.
import { audit_of, moves_of, type Audit, type Moves, type Summary } from "./print.ts";
import type { Source } from "./source.ts";

export type Trouble = string | { message: string; field?: string };
/** Whether its moves can be shown, now or soon. */
export const can_be_shown = (p: PrintState) => p.state !== "failed" || p.summary !== undefined;
export const words_of = (trouble: Trouble | undefined) => (typeof trouble === "object" ? trouble.message : (trouble ?? ""));
export interface PrintState { id: number; name: string; state: "reading" | "drawn" | "audited" | "failed"; error?: Trouble; progress?: number; stage?: string; summary?: Summary }
export interface Option {
  name: string; group: "printer" | "material" | "print"; section: string; unit: string; min?: number | null; max?: number | null;
  kind: "flag" | "integer" | "number" | "percent" | "length_or_share" | "text" | "choice" | "point" | "polygon";
  choices?: string[]; per_extruder: boolean; help: string; default: string;
}
/** Protection: what a level of it sets, in the form of a profile; older programs do not tell. */
export interface Profile {
  group: "printer" | "material" | "print" | "protection"; name: string; description?: string; extruders?: number; default_material?: string;
  default_print?: string; audit_only?: boolean; chosen?: boolean; turns?: boolean; settings: Record<string, string>;
}
export interface Mesh { id: number; name: string; bytes: number }
export interface JobRequest {
  meshes: { id: number; extruder: number }[]; printer: string; materials: string[]; print: string; settings: Record<string, string>; protect: string; azimuth?: string;
}
export interface JobSummary {
  layers: number; tool_changes: number; time_s: number; azimuth_deg: number; rampart_g: number;
  extruders: { extruder: number; filament_mm: number; filament_g: number; cost: number }[];
}
export interface Job {
  id: number; state: "queued" | "running" | "done" | "failed" | "cancelled"; position?: number; stage?: string; progress?: number;
  warnings?: string[]; error?: Trouble; print?: number; summary?: JobSummary; name?: string;
}

/** What the server refused, in its words; `field` names the option at fault, if one is. */
export class Refusal extends Error {
  constructor(message: string, readonly status: number, readonly field?: string) { super(message); }
}

async function ask(path: string, init?: RequestInit): Promise<Response> {
  const answer = await fetch(path, init).catch(() => { throw new Refusal("the program no longer answers: is it still running?", 0); });
  if (answer.ok) return answer;
  let message = `the program answered with status ${answer.status}`;
  let field: string | undefined;
  try {
    const said = (await answer.json()) as { error?: { message?: string; field?: string } };
    message = said.error?.message ?? message;
    field = said.error?.field;
  } catch { /* no JSON: the status must do */ }
  throw new Refusal(message, answer.status, field);
}

const json = async <T>(path: string, init?: RequestInit) => (await (await ask(path, init)).json()) as T;
const named = (path: string, file: File) => json<{ id: number }>(`${path}?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
const forget = (path: string) => ask(path, { method: "DELETE" }).then(() => undefined);

export const api = {
  /** Prints that failed with their summary, where they failed only in the audit. */
  prints: async () => Promise.all((await json<PrintState[]>("/api/prints")).map((p) => (p.state === "failed" ? api.print(p.id).catch(() => p) : p))),
  print: (id: number) => json<PrintState>(`/api/prints/${id}`),
  moves: async (id: number) => (await ask(`/api/prints/${id}/moves`)).arrayBuffer(),
  audit: async (id: number) => (await ask(`/api/prints/${id}/audit`)).arrayBuffer(),
  add_print: (file: File) => named("/api/prints", file),
  forget_print: (id: number) => forget(`/api/prints/${id}`),
  gcode_address: (id: number) => `/api/prints/${id}/gcode`,
  options: () => json<Option[]>("/api/options"),
  profiles: () => json<Profile[]>("/api/profiles"),
  add_printer: (file: File) => json<{ name: string }>(`/api/profiles?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file }),
  forget_printer: (name: string) => forget(`/api/profiles/${encodeURIComponent(name)}`),
  meshes: () => json<Mesh[]>("/api/meshes"),
  add_mesh: (file: File) => named("/api/meshes", file),
  forget_mesh: (id: number) => forget(`/api/meshes/${id}`),
  jobs: () => json<Job[]>("/api/jobs"),
  job: (id: number) => json<Job>(`/api/jobs/${id}`),
  slice: (job: JobRequest) => json<{ id: number }>("/api/jobs", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(job) }),
  end_job: (id: number) => forget(`/api/jobs/${id}`),
};

export const pause = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

export class ServerSource implements Source {
  constructor(readonly id: number) {}

  async drawn(said: (stage: string, progress: number) => void): Promise<{ summary: Summary; moves: Moves }> {
    const state = await this.until((s) => s.summary !== undefined, said);
    return { summary: state.summary!, moves: moves_of(await api.moves(this.id)) };
  }

  async audited(said: (stage: string, progress: number) => void): Promise<Audit> {
    await this.until((s) => s.state === "audited", said);
    return audit_of(await api.audit(this.id));
  }

  private async until(there: (s: PrintState) => boolean, said: (stage: string, progress: number) => void): Promise<PrintState> {
    for (let wait_ms = 30; ; wait_ms = Math.min(400, wait_ms * 1.4)) {
      const state = await api.print(this.id);
      if (there(state)) return state; // also of a print that failed later: its moves are there
      if (state.state === "failed") throw new Refusal(words_of(state.error) || "the file cannot be read", 0);
      said(state.stage || "reading", state.progress ?? 0);
      await pause(wait_ms);
    }
  }
}
