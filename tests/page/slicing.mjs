// Slicing from the page: upload, an error at its field, progress, queue and cancel, reload, download.
import assert from "node:assert/strict";
import path from "node:path";
import { audited, open_page, picture, root, test } from "./harness.mjs";

const model = (name) => path.join(root, "models", name);

export async function slicing(chrome, address) {
  const page = await open_page(chrome, address);
  const job = (id, state) => page.waitForSelector(`#jobs li[data-job="${id}"][data-state="${state}"]`, { timeout: 60000 });

  await test("meshes uploaded open the slicing panel, each with an extruder of its own", async () => {
    await page.waitForSelector("#option-layer_height", { state: "attached" });
    await page.setInputFiles("#file", [model("4-cones_black.stl"), model("4-cones_white.stl")]);
    await page.waitForFunction(() => document.querySelectorAll(".parts li").length === 2);
    assert.deepEqual(await page.locator(".parts select").evaluateAll((all) => all.map((s) => s.value)), ["0", "1"]);
    await picture(page, "slice");
  });

  await test("parts come back to their extruders after a printer with one", async () => {
    const extruders = () => page.locator(".parts select").evaluateAll((all) => all.map((s) => s.value));
    const before = await page.locator("#printer").inputValue();
    const profiles = await (await page.request.get(new URL("/api/profiles", address).href)).json();
    const single = profiles.find((p) => p.group === "printer" && p.extruders === 1 && !p.audit_only);
    await page.locator(".parts select").nth(0).selectOption("1");
    await page.selectOption("#printer", single.name);
    assert.deepEqual(await extruders(), ["0", "0"]);
    await page.selectOption("#printer", before);
    assert.deepEqual(await extruders(), ["1", "1"]);
    await page.locator(".parts select").nth(0).selectOption("0");
  });

  await test("a printer's own profile is taken beside meshes and chosen, and what is wrong with one is told at the printer", async () => {
    const before = await page.locator("#printer").inputValue();
    const send = (name, toml) => page.setInputFiles("#file", { name, mimeType: "application/toml", buffer: Buffer.from(toml) });
    await send("broken.toml", "# mine\nnozle_diameter = [0.4, 0.4]\n");
    const error = page.locator("#printer-error");
    await error.waitFor({ state: "visible" });
    assert.match(await error.textContent(), /^broken\.toml:2: there is no option 'nozle_diameter'; did you mean 'nozzle_diameter'\?$/);
    assert.equal(await page.locator("#printer").inputValue(), before);
    await picture(page, "printer-error");
    await send("three.toml", 'inherits = "generic"\nnozzle_diameter = [0.4, 0.4, 0.4]\nnozzle_offset = [[0, 0], [20, 0], [40, 0]]\n');
    await page.waitForFunction(() => document.getElementById("printer").value === "three.toml");
    assert.ok(!(await error.isVisible()));
    assert.equal(await page.locator(".parts select").first().locator("option").count(), 3);
    await page.selectOption("#printer", before);
  });

  await test("what is wrong with several printers is told together at the printer, and goes with the next that is sound", async () => {
    const before = await page.locator("#printer").inputValue();
    const sent = (name, toml) => ({ name, mimeType: "application/toml", buffer: Buffer.from(toml) });
    const error = page.locator("#printer-error"), own = () => page.locator("#own-printers .name").allTextContents();
    const sound = 'inherits = "generic"\nnozzle_diameter = [0.4, 0.4]\nnozzle_offset = [[0, 0], [20, 0]]\n';
    await page.setInputFiles("#file", [sent("broken.toml", "nozle_diameter = [0.4]\n"), sent("big.toml", "# " + "x".repeat(1100000)), sent("two.toml", sound), sent("auditor.toml", `audit_only = true\n${sound}`)]);
    await error.waitFor({ state: "visible" });
    const lines = (await error.textContent()).split("\n");
    assert.equal(lines.length, 3, lines.join("|"));
    assert.match(lines[0], /^broken\.toml:1: /);
    assert.match(lines[1], /^big\.toml: /);
    assert.match(lines[2], /^auditor\.toml: .*only to audit/);
    assert.ok(!(await page.locator("#slice-error").isVisible()));
    assert.equal(await page.locator("#printer").inputValue(), "two.toml");
    const known = async () => (await (await page.request.get(new URL("/api/profiles", address).href)).json()).filter((p) => p.name.endsWith(".toml")).map((p) => p.name);
    assert.deepEqual((await known()).sort(), ["three.toml", "two.toml"], "what cannot be used takes no place");
    await picture(page, "printers-error");

    await page.route("**/api/profiles?name=*", (route) => route.fulfill({ status: 503, json: { error: { message: "there are 64 printers already; forget one" } } }));
    await page.setInputFiles("#file", [sent("more.toml", sound)]);
    await page.waitForFunction(() => document.getElementById("printer-error").textContent === "more.toml: there are 64 printers already; forget one");
    await page.unroute("**/api/profiles?name=*");

    assert.deepEqual((await own()).sort(), ["three.toml", "two.toml"]);
    await page.getByRole("button", { name: "Remove two.toml" }).click();
    await page.waitForFunction(() => document.querySelectorAll("#own-printers li").length === 1);
    assert.ok(!(await error.isVisible()));
    assert.equal(await page.locator("#printer").inputValue(), before, "another printer is chosen in its place");
    assert.ok(await page.getByRole("button", { name: "Remove three.toml" }).evaluate((b) => b === document.activeElement));
    await page.keyboard.press("Enter");
    await page.locator("#own-printers").waitFor({ state: "hidden" });
    assert.deepEqual(await known(), []);
    assert.ok(await page.locator("#add-printer").evaluate((b) => b === document.activeElement));
    assert.ok(!(await page.locator("#printer option").allTextContents()).some((name) => name.endsWith(".toml")));
  });

  await test("a value out of range is told in words at its field", async () => {
    await page.fill("#option-layer_height", "99");
    await page.keyboard.press("Tab");
    await page.click("#slice");
    const error = page.locator("#option-layer_height-error");
    await error.waitFor({ state: "visible" });
    assert.match(await error.textContent(), /layer_height/);
    await picture(page, "slice-error");
    await page.fill("#option-layer_height", "0.3");
    await page.keyboard.press("Tab");
  });

  await test("an azimuth is taken as --azimuth takes it, and what is none is told at its field", async () => {
    const azimuth = page.locator("#option-azimuth"), error = page.locator("#option-azimuth-error");
    assert.equal(await azimuth.getAttribute("placeholder"), "auto");
    await page.selectOption("#protect", "none");
    assert.equal(await azimuth.getAttribute("placeholder"), "off");
    const levels = (await (await page.request.get(new URL("/api/profiles", address).href)).json()).filter((p) => p.group === "protection");
    for (const { name, settings } of levels) {
      await page.selectOption("#protect", name);
      for (const [option, value] of Object.entries(settings)) assert.match(await page.locator(`#option-${option} option`).first().textContent(), new RegExp(`^${value} `));
    }
    await page.selectOption("#protect", "full");
    await azimuth.fill("north");
    await page.keyboard.press("Tab");
    await page.click("#slice");
    await error.waitFor({ state: "visible" });
    assert.match(await error.textContent(), /'north' is neither auto nor off/);
    await azimuth.fill("");
    await page.keyboard.press("Tab");
  });

  await test("all options are there, and can be searched", async () => {
    await page.click("#all-options > summary");
    await page.fill("#option-search", "retract");
    const shown = await page.locator(".all-options .option:visible").count();
    assert.ok(shown > 2 && shown < 40, `${shown} options`);
    await page.click("#all-options > summary");
  });

  await test("a job is queued behind another, both can be cancelled, and a reload finds them", async () => {
    await page.fill("#option-layer_height", "0.05");
    await page.keyboard.press("Tab");
    await page.click("#slice");
    await page.waitForSelector('#jobs li[data-job="1"]');
    await page.click("#slice");
    await page.waitForSelector('#jobs li[data-job="2"]');
    const cancel = page.locator('#jobs li[data-job="1"] button', { hasText: "Cancel" });
    await cancel.focus();
    await page.evaluate(() => { window.row_of_1 = document.querySelector('#jobs li[data-job="1"]'); });
    await job(1, "running");
    await page.waitForTimeout(1000); // the queue is asked for several times
    assert.ok(await cancel.evaluate((b) => b === document.activeElement && window.row_of_1.contains(b)), "the focus stays on Cancel while the job goes on");
    assert.equal(await page.locator('#jobs li[data-job="1"] [aria-live]').textContent(), "running");
    await page.locator('#jobs li[data-job="2"] button', { hasText: "Cancel" }).click();
    await page.locator('#jobs li[data-job="1"] button', { hasText: "Cancel" }).click();
    await job(2, "cancelled");
    await job(1, "cancelled");
    await page.reload();
    await page.click("#tab-slice");
    await job(1, "cancelled");
    await page.waitForFunction(() => document.querySelectorAll(".parts li").length === 2);
  });

  await test("a job that ends well is shown, and its G-code can be downloaded", async () => {
    await page.fill("#option-layer_height", "0.32");
    await page.fill("#option-azimuth", "30");
    await page.keyboard.press("Tab");
    await page.click("#slice");
    await job(3, "done");
    const { summary } = await (await page.request.get(new URL("/api/jobs/3", address).href)).json();
    assert.equal(summary.azimuth_deg, 30);
    await picture(page, "sliced");
    await audited(page);
    const [file] = await Promise.all([page.waitForEvent("download"), page.click('#jobs li[data-job="3"] a')]);
    assert.match(file.suggestedFilename(), /\.gcode$/);
    await picture(page, "sliced");
    // What was refused above are the only complaints there are.
    assert.deepEqual(page.troubles.filter((t) => !/status of (400|413|503)/.test(t)), []);
  });

  await test("with a print forgotten goes the job that made it; another job's row can be forgotten by itself", async () => {
    page.on("dialog", (d) => void d.accept());
    await page.click("#forget");
    await page.waitForFunction(() => !document.querySelector('#jobs li[data-job="3"]'));
    await page.locator('#jobs li[data-job="2"] button', { hasText: "Forget" }).click();
    await page.waitForFunction(() => !document.querySelector('#jobs li[data-job="2"]'));
    assert.ok(await page.evaluate(() => document.querySelector('#jobs li[data-job="1"]').contains(document.activeElement)), "the focus goes on to the row beside");
  });
  await page.context().close();

  await test("meshes uploaded before the profiles are there get an extruder each, too", async () => {
    let arrive = () => undefined;
    const wait = new Promise((r) => { arrive = r; });
    const late = await open_page(chrome, address, {}, (page) => page.route("**/api/profiles", async (route) => { await wait; await route.continue(); }));
    await late.waitForFunction(() => window.cleancolor);
    await late.setInputFiles("#file", [model("two-color-world-50mm_ocean.stl"), model("two-color-world-50mm_land.stl")]);
    await late.waitForFunction(() => document.querySelectorAll(".parts li").length === 2);
    arrive();
    await late.waitForFunction(() => document.querySelectorAll(".parts li").length === 4);
    const extruders = await late.locator(".parts select").evaluateAll((all) => all.map((s) => s.value));
    assert.deepEqual(extruders.slice(0, 2), ["0", "1"]);
    await late.context().close();
  });
}
