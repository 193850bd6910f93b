// Opening files: G-code dropped on the page, meshes other than STL, and what is neither.
import assert from "node:assert/strict";
import { two_blocks } from "./gcode.mjs";
import { audited, open_page, picture, test } from "./harness.mjs";
import { cube_3mf, obj_cube } from "./meshes.mjs";

/** Drags files ({name: text}) over the page and drops them. */
async function drop(page, files) {
  const data = await page.evaluateHandle((files) => {
    const data = new DataTransfer();
    for (const [name, text] of Object.entries(files)) data.items.add(new File([text], name));
    return data;
  }, files);
  await page.dispatchEvent("body", "dragenter", { dataTransfer: data });
  assert.ok(await page.locator(".curtain").isVisible(), "the page says where files can be dropped");
  await page.dispatchEvent("body", "drop", { dataTransfer: data });
  assert.ok(!(await page.locator(".curtain").isVisible()));
}

export async function opening(chrome, address) {
  const page = await open_page(chrome, address);

  await test("G-code dropped on the page is shown", async () => {
    await page.locator(".welcome").waitFor({ state: "visible" });
    await drop(page, { "dropped.gcode": two_blocks() });
    await audited(page);
    assert.deepEqual(await page.evaluate(() => window.cleancolor.viewer.sides.map((s) => s.name)), ["dropped.gcode"]);
    await picture(page, "dropped");
  });

  await test("what is neither G-code nor a mesh is told by its name", async () => {
    await drop(page, { "letter.pdf": "nothing to print" });
    await page.waitForFunction(() => /letter\.pdf: neither/.test(document.querySelector(".status").textContent));
  });

  for (const [name, bytes] of [["cube.obj", obj_cube()], ["other.3mf", cube_3mf()]])
    await test(`${name} is taken as a part, and sliced`, async () => {
      await page.waitForSelector("#option-layer_height", { state: "attached" });
      await page.setInputFiles("#file", { name, mimeType: "application/octet-stream", buffer: bytes });
      await page.waitForFunction(() => document.querySelectorAll(".parts li").length === 1);
      assert.deepEqual(await page.locator(".parts .name").allTextContents(), [name]);
      await page.click("#slice");
      await page.waitForFunction((made) => window.cleancolor.viewer.first?.name === made, name.replace(/\..*/, ".gcode"), { timeout: 60000 });
      await audited(page);
      const [low, high] = await page.evaluate(() => window.cleancolor.viewer.first.summary.part_box_mm);
      for (const c of [0, 1, 2]) assert.ok(Math.abs(high[c] - low[c] - 10) < 0.4, `as large as the cube: ${low} to ${high}`);
      await page.locator(".parts button").click();
      assert.deepEqual(page.troubles, []);
    });
  await page.context().close();
}
