// One print that cannot be read, or not audited, leaves the page with the others, and the page says why.
import assert from "node:assert/strict";
import { audited, open_page, test } from "./harness.mjs";

const names = (page) => page.evaluate(() => window.cleancolor.viewer.sides.map((s) => s.name));
const status = (page) => page.locator(".status").textContent();

export async function troubled(chrome, address) {
  await test("a file that cannot be read does not hide one that can, and the page says why", async () => {
    const page = await open_page(chrome, address);
    await audited(page);
    assert.deepEqual(await names(page), ["blocks.gcode"]);
    await page.waitForFunction(() => /bad\.gcode/.test(document.querySelector(".status").textContent));
    assert.ok(await page.locator(".status").isVisible());
    assert.match(await status(page), /bad\.gcode: .{10}/);
    assert.equal(await page.locator("#print").inputValue(), "1");
    assert.deepEqual(page.troubles, []);
    await page.context().close();
  });
}
