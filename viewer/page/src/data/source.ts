// Where the data of one print come from: the server (api.ts), or the report's own file (embedded.ts). What draws does
// not know which.
import type { Audit, Moves, Summary } from "./print.ts";

export interface Source {
  /** Resolves when the moves can be drawn. `said` hears how far reading is, in words and as a share. */
  drawn(said: (stage: string, progress: number) => void): Promise<{ summary: Summary; moves: Moves }>;
  /** Resolves when the print is audited. Call after drawn(). */
  audited(said: (stage: string, progress: number) => void): Promise<Audit>;
}
