// A print embedded in the report's file. For print N (from 0) the HTML holds
//   <script type="application/json" id="cleancolor-N-summary">…</script>
//   <script type="application/octet-stream" id="cleancolor-N-moves" data-encoding="deflate">BASE64</script>
//   <script type="application/octet-stream" id="cleancolor-N-audit" data-encoding="deflate">BASE64</script>
// with the bytes of the server's binary answers; data-encoding is "deflate" (zlib), "gzip", or absent where they are plain.
import { audit_of, moves_of, type Audit, type Moves, type Summary } from "./print.ts";
import type { Source } from "./source.ts";

const element = (n: number, what: string) => document.getElementById(`cleancolor-${n}-${what}`);

async function bytes_of(script: HTMLElement): Promise<ArrayBuffer> {
  const text = atob((script.textContent ?? "").trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  script.textContent = ""; // as large as the print, and not needed again
  const encoding = script.dataset["encoding"];
  if (!encoding) return bytes.buffer;
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream(encoding as CompressionFormat));
  return new Response(inflated).arrayBuffer();
}

export class EmbeddedSource implements Source {
  constructor(private readonly n: number) {}

  static count(): number {
    let n = 0;
    while (element(n, "summary")) n++;
    return n;
  }

  async drawn(): Promise<{ summary: Summary; moves: Moves }> {
    const moves = element(this.n, "moves");
    if (!moves) throw new Error("this report holds no moves");
    const summary = JSON.parse(element(this.n, "summary")!.textContent ?? "") as Summary;
    return { summary, moves: moves_of(await bytes_of(moves)) };
  }

  async audited(): Promise<Audit> {
    const audit = element(this.n, "audit");
    if (!audit) throw new Error("this report holds no audit");
    return audit_of(await bytes_of(audit));
  }
}
