// The page is fast: first picture of 10 MB of G-code, and 2 million moves under a scrubbing slider, drawn in software.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { audited, finished, open_page, picture, serve, settled, test } from "./harness.mjs";

const bars = { first_picture_ms: 2000, script_ms: 10, draw_calls: 50, settle_ms: 500 };
const first_bytes = 10e6;

/** The value that this share of the numbers does not exceed. */
function quantile(numbers, share) {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)];
}

/** From starting the program, which knows nothing of the file yet, to the picture on the screen. */
async function first_picture_ms(chrome, file) {
  const start = Date.now();
  const server = await serve([file]);
  try {
    const page = await open_page(chrome, server.address);
    await page.waitForFunction(() => performance.getEntriesByName("cleancolor first picture").length > 0, null, { timeout: 60000 });
    const drawn = await page.evaluate(() => performance.timeOrigin + performance.getEntriesByName("cleancolor first picture")[0].startTime);
    assert.deepEqual(page.troubles, []);
    await page.context().close();
    return drawn - start;
  } finally { server.end(); }
}

export const first_picture = (file) => async (chrome) => {
  await test("the first picture of 10 MB of G-code comes within 2 s of starting the program", async () => {
    assert.ok(statSync(file).size >= first_bytes, "the file is as large as promised");
    const tries = [];
    for (let k = 0; k < 3; k++) tries.push(await first_picture_ms(chrome, file));
    const median = quantile(tries, 0.5);
    console.log(`      first picture after ${tries.map(Math.round).join(", ")} ms`);
    assert.ok(median < bars.first_picture_ms, `${median} ms`);
  });
};

/** Changes an input of the page and waits for the full picture: what it took, for each of these values. */
const measured = (page, id, event, values) => page.evaluate(async ([id, event, values]) => {
  const { counters, settled } = window.cleancolor, input = document.getElementById(id), steps = [];
  for (const value of values) {
    await settled();
    counters.script_ms_worst = 0;
    const start = performance.now();
    input.value = String(value);
    input.dispatchEvent(new Event(event));
    const handler_ms = performance.now() - start;
    await settled();
    steps.push({ settle_ms: performance.now() - start, handler_ms, script_ms: Math.max(handler_ms, counters.script_ms_worst), draw_calls: counters.draw_calls, roads: counters.roads });
  }
  return steps;
}, [id, event, values]);

function told(what, steps) {
  const of = (key, share) => quantile(steps.map((s) => s[key]), share);
  console.log(`      ${what}: settles in ${Math.round(of("settle_ms", 0.5))} ms (95 %: ${Math.round(of("settle_ms", 0.95))}), script ${of("script_ms", 0.5).toFixed(1)} ms (95 %: ${of("script_ms", 0.95).toFixed(1)}), ${of("draw_calls", 1)} draw calls, ${of("roads", 1)} roads`);
  return of;
}

export async function two_million(chrome, address) {
  const page = await open_page(chrome, address);
  await test("2 million moves: a frame takes at most 10 ms of script and 50 draw calls, a scrub step settles in 0.5 s", async () => {
    await page.waitForFunction(() => window.cleancolor?.viewer.first?.moves.count > 1.9e6, null, { timeout: 120000 });
    await audited(page);
    await finished(page);
    await settled(page);
    const layers = await page.evaluate(() => window.cleancolor.viewer.first.moves.layer_z.length);
    // Over the whole height and to and fro, and some steps of a layer or two.
    const shares = Array.from({ length: 40 }, (_, k) => (k % 4 === 3 ? ((k - 1) * 0.37) % 1 + 0.003 : (k * 0.37) % 1));
    const of = told("scrubbing", await measured(page, "layer", "input", shares.map((s) => Math.floor(s * (layers - 1)))));
    await picture(page, "two-million");
    assert.ok(of("draw_calls", 1) <= bars.draw_calls);
    assert.ok(of("script_ms", 0.95) <= bars.script_ms, "script");
    assert.ok(of("settle_ms", 0.95) < bars.settle_ms, "settle");
  });

  await test("2 million moves: another colouring takes at most 10 ms of script a frame, and is on the screen within 0.5 s", async () => {
    await page.evaluate(() => { const v = window.cleancolor.viewer; v.go({ layer: v.first.moves.layer_z.length - 1 }); });
    const colourings = await page.locator("#colouring option").evaluateAll((all) => all.map((o) => o.value));
    const of = told("colouring", await measured(page, "colouring", "change", [...colourings.slice(1), ...colourings]));
    assert.ok(of("script_ms", 0.95) <= bars.script_ms, "script");
    assert.ok(of("settle_ms", 0.95) < bars.settle_ms, "settle");
    assert.deepEqual(page.troubles, []);
  });
  await page.context().close();
}
