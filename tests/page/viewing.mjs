// Looking at prints: two of the globe (with and without protection), every colouring, defects, keyboard, phone, dark.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { at, audited, axe_source, finished, open_page, out, picture, settled, test } from "./harness.mjs";

const seriously = async (page) => {
  await page.evaluate(readFileSync(axe_source, "utf8")); // as the page's policy forbids scripts of others
  const found = await page.evaluate(async () => (await window.axe.run(document)).violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(" | ")}`));
  assert.deepEqual(found, []);
};

/** Moves of G-code, counted by its letters: lines that move the carriage or filament (A and B, where each extruder has its own axis). */
const motions = (gcode) => gcode.split("\n").filter((line) => /^G[01]\s/.test(line) && /[XYZEAB]/.test(line.replace(/;.*/, ""))).length;

export async function viewing(chrome, address) {
  const page = await open_page(chrome, address);
  const request = (path) => page.request.get(new URL(path, address).href).then((r) => r.json());

  await test("two prints given are shown side by side, with one set of controls", async () => {
    await audited(page);
    await finished(page);
    assert.equal(await page.evaluate(() => window.cleancolor.viewer.sides.length), 2);
    await picture(page, "side-by-side");
    await page.evaluate(() => window.cleancolor.viewer.go({ layer: 60 }));
    const z = await page.evaluate(() => window.cleancolor.viewer.sides.map((s) => s.moves.layer_z[s.view.shown.layer]));
    assert.ok(Math.abs(z[0] - z[1]) < 0.2, `heights ${z}`);
  });

  const near = (found, told, what, by = 0.002) => assert.ok(Math.abs(found - told) <= by * Math.abs(told) + 0.002, `${what}: ${found} where the audit tells ${told}`);
  /** How many places of a kind a side has, how much of them is to be seen, and how much of that is drawn. */
  const places = (side, kind) => page.evaluate(([side, kind]) => {
    const { places: p } = window.cleancolor.viewer.sides[side].audit, drawn = new Set(window.cleancolor.viewer.sides[side].view.places_shown());
    const sums = { count: 0, seen: 0, drawn: 0, others: 0 };
    for (let k = 0; k < p.count; k++) {
      const seen = kind === 5 ? p.visibility[k] : p.mm3[k];
      if (p.kind[k] !== kind) { sums.others += drawn.has(k); continue; }
      sums.count++;
      sums.seen += seen;
      if (drawn.has(k)) sums.drawn += seen;
    }
    return sums;
  }, [side, kind]);

  await test("moves, layers, tool changes and defects drawn of both prints are those of the audit's JSON", async () => {
    const prints = await request("/api/prints");
    assert.equal(prints.length, 2);
    await page.evaluate(() => { const v = window.cleancolor.viewer; v.go({ layer: v.first.moves.layer_z.length - 1 }); });
    for (const [side, { id, name }] of prints.entries()) {
      const audit = await request(`/api/prints/${id}/audit.json`), { figures, layers, places: defects, ooze } = audit.scenarios.worst;
      const shown = (await page.evaluate(() => window.cleancolor.counts()))[side];
      assert.equal(shown.moves, motions(readFileSync(path.join(out, name), "utf8")));
      assert.equal(shown.layers, audit.print.layers);
      assert.equal(shown.tool_changes, audit.print.tool_changes);
      const listed = await page.evaluate((side) => { const { places: p, worst, worst_mm3 } = window.cleancolor.viewer.sides[side].audit; return worst.map((k, rank) => ({ kind: ["smear", "inner", "own", "hole", "wipe", "zipper"][p.kind[k]], nozzle: p.nozzle[k], layer: p.layer[k] + 1, mm3: worst_mm3[rank] })); }, side);
      const what = ({ kind, nozzle, layer }) => `${kind} of ${nozzle} in ${layer}`;
      assert.deepEqual(listed.map(what), defects.map(what));
      listed.forEach(({ mm3 }, k) => near(mm3, defects[k].mm3, `defect ${k}`));
      const of_layers = await page.evaluate((side) => { const { layer_smear, layer_hole, layer_zippers } = window.cleancolor.viewer.sides[side].audit; return [layer_smear, layer_hole, layer_zippers].map((a) => [...a]); }, side);
      layers.forEach((l, k) => ["smear_volume", "hole_volume", "zippers"].forEach((figure, f) => near(of_layers[f][k], l[figure], `${figure} of layer ${l.layer}`)));
      const assumed = await page.evaluate((side) => window.cleancolor.viewer.sides[side].audit.ooze, side);
      assumed.forEach((rate, n) => assert.deepEqual(rate, { volume_mm3: (ooze[n] ?? ooze.at(-1)).volume_mm3, time_s: (ooze[n] ?? ooze.at(-1)).time_s }));
      for (const [colouring, kind, figure] of [["smear", 0, "smear_volume"], ["hole", 3, "hole_volume"], ["zipper", 5, "zippers_visible"]]) {
        await page.selectOption("#colouring", colouring);
        await settled(page);
        const found = await places(side, kind);
        // Places of less than 0.001 mm3 are in the figure only.
        const told = colouring === "zipper" ? figures[figure] : defects.filter((d) => d.kind === colouring).reduce((sum, d) => sum + d.mm3, 0);
        assert.ok(told > 0 && told <= 1.001 * figures[figure]);
        near(found.seen, told, `${figure} of ${name}`, 0.02);
        near(found.drawn, told, `${figure} drawn of ${name}`, 0.02);
        assert.equal(found.others, 0, "a colouring draws its own kind of damage");
        if (colouring === "zipper") assert.equal(found.count, figures.zippers);
      }
    }
    await page.selectOption("#compare", "");
    await page.waitForFunction(() => window.cleancolor.viewer.sides.length === 1);
    await audited(page);
    await finished(page);
  });

  await test("the layer and move sliders change what is drawn", async () => {
    const drawn = async () => { await settled(page); return page.evaluate(() => ({ ...window.cleancolor.counts()[0], roads: window.cleancolor.counters.roads })); };
    await page.locator("#layer").fill("80");
    assert.equal((await at(page)).layer, 80);
    const whole = await drawn();
    await page.locator("#move").fill("20");
    assert.equal((await at(page)).step, 20);
    assert.ok((await drawn()).top < whole.top);
    await page.locator("#from-layer").fill("40");
    assert.equal((await at(page)).from, 40);
    await picture(page, "layer");
    await page.locator("#from-layer").fill("0");
    const box = await page.locator(".profile").boundingBox();
    await page.mouse.click(box.x + 20, box.y + box.height * 0.25);
    const there = await at(page);
    assert.ok(Math.abs(there.layer / there.layers - 0.75) < 0.03, "a click on the profile goes to its layer");
  });

  await test("every colouring draws a picture of its own", async () => {
    await page.evaluate(() => { const v = window.cleancolor.viewer; v.go({ layer: v.first.moves.layer_z.length - 1 }); });
    const seen = new Set();
    for (const colouring of await page.locator("#colouring option").evaluateAll((all) => all.map((o) => o.value))) {
      await page.selectOption("#colouring", colouring);
      await settled(page);
      seen.add((await page.locator(".picture").screenshot({ path: new URL(`../../build/page-test/colour-${colouring}.png`, import.meta.url).pathname })).toString("base64"));
      const legend = await page.locator(".legend li").allTextContents();
      assert.ok(legend.length > 0);
      if (colouring === "role") assert.deepEqual(legend.filter((role) => /rampart|skirt/.test(role)).sort(), ["rampart", "skirt brim"], "walls, and the brim they stand on");
    }
    assert.equal(seen.size, 8);
    await page.selectOption("#colouring", "extruder");
  });

  await test("a click on a defect takes sliders, camera and marker there", async () => {
    const before = await page.evaluate(() => window.cleancolor.viewer.stage.camera.position.toArray());
    await page.locator("#defects button").nth(1).click();
    const place = await page.evaluate(() => { const v = window.cleancolor.viewer, p = v.first.audit.places, k = v.selected.place; return { layer: v.first.moves.layer[p.move[k]], marker: v.marker.object.position.toArray(), from: [...p.from.slice(3 * k, 3 * k + 3)] }; });
    assert.equal((await at(page)).layer, place.layer);
    assert.ok(Math.hypot(...place.marker.map((x, c) => x - place.from[c])) < 6);
    await page.waitForTimeout(100);
    assert.notDeepEqual(await page.evaluate(() => window.cleancolor.viewer.stage.camera.position.toArray()), before);
    await picture(page, "defect");
  });

  await test("the keyboard does all of it, and ? tells how", async () => {
    await page.locator(".picture").focus();
    await page.keyboard.press("h");
    await page.evaluate(() => window.cleancolor.viewer.go({ layer: 50 }));
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("Shift+ArrowDown");
    assert.equal((await at(page)).layer, 41);
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    assert.equal((await at(page)).step, 1);
    await page.keyboard.press(" ");
    await page.waitForFunction(() => window.cleancolor.viewer.at.step > 3 || window.cleancolor.viewer.at.layer > 41);
    await page.keyboard.press(" ");
    assert.equal(await page.evaluate(() => window.cleancolor.viewer.playing), false);
    await page.keyboard.press("n");
    assert.ok(await page.evaluate(() => window.cleancolor.viewer.selected));
    await page.keyboard.press("?");
    assert.ok(await page.locator("#help").isVisible());
    await picture(page, "keys");
    await page.click("#help button");
    assert.ok(!(await page.locator("#help").isVisible()));
  });

  await test("prints opened again and again, some before the last was drawn, take no more of the graphics card", async () => {
    const held = async () => { await audited(page); await finished(page); await settled(page); return page.evaluate(() => ({ ...window.cleancolor.viewer.stage.renderer.info.memory, programs: window.cleancolor.viewer.stage.renderer.info.programs.length })); };
    const open = (wait_ms) => page.evaluate(async (wait_ms) => {
      const { viewer } = window.cleancolor, opened = viewer.open(viewer.sides.map(({ name, source }) => ({ name, source })), () => undefined);
      if (wait_ms) await new Promise((r) => setTimeout(r, wait_ms)); else await opened;
    }, wait_ms);
    await page.selectOption("#colouring", "smear");
    await open(0);
    const first = await held();
    for (const wait_ms of [0, 150, 300, 600, 0]) await open(wait_ms);
    assert.deepEqual(await held(), first);
    await page.selectOption("#colouring", "extruder");
  });

  await test("the G-code can be downloaded", async () => {
    const [file] = await Promise.all([page.waitForEvent("download"), page.click("#download")]);
    assert.match(file.suggestedFilename(), /\.gcode$/);
  });

  await test("axe-core finds nothing serious, and the console is silent", async () => {
    for (const tab of ["figures", "slice", "defects"]) { await page.click(`#tab-${tab}`); await seriously(page); }
    await page.click("#tab-figures");
    await picture(page, "figures");
    assert.deepEqual(page.troubles, []);
  });
  await page.context().close();

  await test("at phone width nothing is cut off; dark is dark", async () => {
    const phone = await open_page(chrome, address, { viewport: { width: 390, height: 844 }, colorScheme: "dark", hasTouch: true });
    await audited(phone);
    await finished(phone);
    assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth <= 390));
    assert.ok(await phone.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).every((c) => c < 60)));
    await seriously(phone);
    await picture(phone, "phone-dark");
    assert.deepEqual(phone.troubles, []);
    await phone.context().close();
  });
}
