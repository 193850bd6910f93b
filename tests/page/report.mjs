// The report of `cleancolor audit` draws its prints without a server, beside all that it shows without scripts.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import path from "node:path";
import { audited, finished, open_page, out, picture, program, test } from "./harness.mjs";

const written = (name, ...words) => {
  const file = path.join(out, name);
  execFileSync(program, ["audit", ...words, "--printer", "replicator-dual", "--quiet", "-o", file], { cwd: out, stdio: "inherit" });
  return `file://${file}`;
};

export async function report(chrome, address) {
  await test("a report draws its print without a server", async () => {
    const served = await open_page(chrome, address);
    await audited(served);
    const { summary } = await (await served.request.get(new URL("/api/prints/1", address).href)).json();
    await served.context().close();
    const page = await open_page(chrome, written("report.html", "protected.gcode"));
    await audited(page);
    await finished(page);
    assert.equal(await page.evaluate(() => window.cleancolor.counts()[0].moves), summary.moves);
    await page.locator("#defects button").first().click();
    await page.locator("#cleancolor-report").scrollIntoViewIfNeeded();
    await picture(page, "report");
    await page.screenshot({ path: path.join(out, "report-whole.png"), fullPage: true });

    const zoom = () => page.evaluate(() => window.cleancolor.viewer.stage.camera.position.length());
    const turn_wheel = async () => { await page.locator(".picture").hover(); await page.mouse.wheel(0, 100); await page.waitForTimeout(300); };
    const before = await zoom(), scrolled = await page.evaluate(() => window.scrollY);
    await turn_wheel();
    assert.equal(await zoom(), before);
    assert.ok(await page.evaluate(() => window.scrollY) > scrolled, "the wheel scrolls the report");
    await page.locator(".picture").click();
    await turn_wheel();
    assert.notEqual(await zoom(), before, "after a click it zooms");
    assert.deepEqual(page.troubles, []);
    await page.context().close();
  });

  await test("a report of two prints shows them side by side", async () => {
    const page = await open_page(chrome, written("report-two.html", "protected.gcode", "bare.gcode"));
    await audited(page);
    assert.deepEqual(await page.evaluate(() => window.cleancolor.viewer.sides.map((s) => s.name)), ["protected.gcode", "bare.gcode"]);
    await page.locator("#cleancolor-report").scrollIntoViewIfNeeded();
    await picture(page, "report-two");
    assert.deepEqual(page.troubles, []);
    await page.context().close();
  });

  await test("a report without scripts shows figures and pictures, and no empty place", async () => {
    const page = await open_page(chrome, `file://${path.join(out, "report.html")}`, { javaScriptEnabled: false });
    assert.ok(await page.locator(".cards").isVisible());
    assert.ok(!(await page.locator(".scene").isVisible()));
    await page.context().close();
  });

  await test("a report without the scene runs no script", async () => {
    const page = await open_page(chrome, written("report-plain.html", "protected.gcode", "--no-scene"));
    assert.equal(await page.locator("script, #cleancolor-report").count(), 0);
    await page.context().close();
  });
}
