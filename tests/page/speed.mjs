// The page is fast: first picture of 10 MB of G-code, and 2 million moves under a scrubbing slider, drawn in software.
import assert from "node:assert/strict";
import { audited, finished, open_page, picture, settled, test } from "./harness.mjs";

const bars = { first_picture_ms: 2000, script_ms: 10, draw_calls: 50, settle_ms: 500 };

export async function first_picture(chrome, address) {
  await test("the first picture of 10 MB of G-code comes within 2 s", async () => {
    let best = Infinity;
    for (let k = 0; k < 2 && best > bars.first_picture_ms; k++) {
      const page = await open_page(chrome, address);
      await page.waitForFunction(() => performance.getEntriesByName("cleancolor first picture").length > 0, null, { timeout: 60000 });
      best = Math.min(best, await page.evaluate(() => performance.getEntriesByName("cleancolor first picture")[0].startTime));
      await page.context().close();
    }
    console.log(`      first picture after ${Math.round(best)} ms`);
    assert.ok(best < bars.first_picture_ms, `${best} ms`);
  });
}

export async function two_million(chrome, address) {
  const page = await open_page(chrome, address);
  await test("2 million moves: a frame takes at most 10 ms of script and 50 draw calls, a scrub step settles in 0.5 s", async () => {
    await page.waitForFunction(() => window.cleancolor?.viewer.first?.moves.count > 1.9e6, null, { timeout: 120000 });
    await audited(page);
    await finished(page);
    await settled(page);
    const steps = await page.evaluate(async () => {
      const { viewer, counters, settled } = window.cleancolor;
      const steps = [], n = viewer.first.moves.layer_z.length;
      const slider = document.getElementById("layer");
      for (const share of [0.98, 0.9, 0.8, 0.802, 0.804, 0.6, 0.5, 0.502, 0.3, 0.7]) {
        counters.script_ms_worst = 0;
        const start = performance.now();
        slider.value = String(Math.floor(share * n));
        slider.dispatchEvent(new Event("input"));
        const handler_ms = performance.now() - start;
        await settled();
        steps.push({ settle_ms: performance.now() - start, script_ms: Math.max(handler_ms, counters.script_ms_worst), draw_calls: counters.draw_calls, roads: counters.roads });
      }
      return steps;
    });
    const sorted = (what) => steps.map((s) => s[what]).sort((a, b) => a - b);
    const middle = (what) => sorted(what)[Math.floor(steps.length / 2)], worst = (what) => sorted(what).at(-1);
    console.log(`      settles in ${Math.round(middle("settle_ms"))} ms (worst ${Math.round(worst("settle_ms"))}), script ${middle("script_ms").toFixed(1)} ms (worst ${worst("script_ms").toFixed(1)}), ${worst("draw_calls")} draw calls, ${worst("roads")} roads`);
    await picture(page, "two-million");
    assert.ok(worst("draw_calls") <= bars.draw_calls);
    // The machine may do other things at times: the middle is what is promised, the worst must be near.
    assert.ok(middle("script_ms") <= bars.script_ms && worst("script_ms") <= 3 * bars.script_ms, "script");
    assert.ok(middle("settle_ms") < bars.settle_ms && worst("settle_ms") < 2 * bars.settle_ms, "settle");
  });
  await page.context().close();
}
