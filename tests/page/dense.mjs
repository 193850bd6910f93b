// Layers of more roads than one chunk of the drawing holds are drawn whole.
import assert from "node:assert/strict";
import { finished, open_page, picture, settled, test } from "./harness.mjs";

export const plate_roads = 140000; // of each of three layers; a chunk holds 131072

export async function dense(chrome, address) {
  const page = await open_page(chrome, address);
  /** Roads of the cut drawn, and triangles the graphics card was given, of which four are a road's. */
  const drawn = async () => { await settled(page); return page.evaluate(() => { const { top, under, floor } = window.cleancolor.counts()[0], { roads, triangles } = window.cleancolor.counters; return { top, under, floor, roads, triangles }; }); };
  const others = async () => page.evaluate(() => { // triangles that are no roads: nozzles, bed
    let sum = 0;
    const { renderer, camera } = window.cleancolor.viewer.stage, { scene } = window.cleancolor.viewer.first.view, roads = [];
    scene.traverse((o) => { if (o.visible && o.material?.uniforms?.roads) roads.push(o); });
    roads.forEach((o) => { o.visible = false; });
    renderer.info.reset();
    renderer.render(scene, camera);
    sum = renderer.info.render.triangles;
    roads.forEach((o) => { o.visible = true; });
    return sum;
  });

  await test("a layer of more roads than a chunk holds is drawn whole, at the cut, below it and as the lowest shown", async () => {
    await page.waitForFunction(() => window.cleancolor?.viewer.sides.length > 0, null, { timeout: 40000 });
    await finished(page);
    await page.evaluate(() => { const v = window.cleancolor.viewer; v.set_from(1); v.go({ layer: 2 }); });
    const whole = await drawn();
    await picture(page, "dense");
    assert.deepEqual([whole.top, whole.under, whole.floor], [plate_roads, plate_roads, plate_roads]);
    assert.equal(whole.triangles, 4 * whole.roads + (await others()), "all roads are given to the graphics card");
  });

  await test("the move slider draws the first roads of such a layer, on either side of a chunk's end", async () => {
    for (const step of [100000, 139000]) {
      const done = await page.evaluate((step) => {
        const v = window.cleancolor.viewer, { order, layer_start, flags } = v.first.moves;
        v.go({ layer: 2, step });
        let roads = 0;
        for (let k = 0; k < step; k++) roads += flags[order[layer_start[2] + k]] & 1;
        return roads;
      }, step);
      const part = await drawn();
      assert.equal(part.top, done);
      assert.equal(part.triangles, 4 * part.roads + (await others()));
    }
    assert.deepEqual(page.troubles, []);
  });
  await page.context().close();
}
