// Numbers in words: times, amounts, the names of kinds.
import { kinds, type Kind } from "../data/print.ts";

export function duration(seconds: number): string {
  const s = Math.max(0, Math.round(seconds));
  const h = Math.floor(s / 3600), m = Math.floor(s / 60) % 60;
  if (h > 0) return `${h} h ${String(m).padStart(2, "0")} min`;
  return m > 0 ? `${m} min ${String(s % 60).padStart(2, "0")} s` : `${s} s`;
}

/** What is wrong with a file, after its name unless the words name it. */
export const named = (name: string, words: string) => (words.includes(name) ? words : `${name}: ${words}`);

/** Three digits that matter; thousands apart. */
export function amount(x: number): string {
  if (!Number.isFinite(x)) return "–";
  if (Number.isInteger(x) || Math.abs(x) >= 100) return Math.round(x).toLocaleString("en").replace(/,/g, " ");
  return x.toFixed(Math.abs(x) < 0.1 ? 3 : Math.abs(x) < 10 ? 2 : 1);
}

const names: Record<Kind, string> = { smear: "smear", inner: "hidden smear", own: "blob", hole: "hole", wipe: "wipe", zipper: "seam" };
export const kind_name = (kind: number) => names[kinds[kind] ?? "smear"];

/** What a place is, in one line: "smear of 2 on 1". */
export function place_title(kind: number, nozzle: number, over: number): string {
  const k = kinds[kind];
  if (k === "smear" || k === "inner") return `${kind_name(kind)} of ${nozzle + 1} on ${over + 1}`;
  return `${kind_name(kind)} in ${nozzle + 1}`;
}
