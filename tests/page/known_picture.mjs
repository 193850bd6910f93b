// A file written by hand renders to a known picture: colours at places whose position on the screen follows from the
// camera, so that it holds for any driver.
import assert from "node:assert/strict";
import { audited, finished, open_page, picture, settled, test } from "./harness.mjs";

/** Mean colour of 5 x 5 pixels of the picture around where a point (mm) is. */
async function colour_at(page, [x, y, z]) {
  await settled(page);
  const shot = (await page.locator(".picture").screenshot()).toString("base64");
  return page.evaluate(async ([png, x, y, z]) => {
    const image = new Image();
    const bytes = Uint8Array.from(atob(png), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = document.createElement("canvas");
    canvas.width = bitmap.width; canvas.height = bitmap.height;
    const c = canvas.getContext("2d");
    c.drawImage(bitmap, 0, 0);
    const [u, v] = window.cleancolor.project(x, y, z);
    const { data } = c.getImageData(Math.round(u) - 2, Math.round(v) - 2, 5, 5);
    return [0, 1, 2].map((k) => { let sum = 0; for (let i = k; i < data.length; i += 4) sum += data[i]; return sum / 25; });
  }, [shot, x, y, z]);
}

/** How far a colour's hue is from another's: 0 same, 1 nothing alike; brightness does not matter. */
function unlike(a, b) {
  const unit = (c) => { const grey = Math.min(...c), d = c.map((x) => x - grey), n = Math.hypot(...d) || 1; return d.map((x) => x / n); };
  const [u, v] = [unit(a), unit(b)];
  return 1 - u.reduce((s, x, i) => s + x * v[i], 0);
}

export async function known_picture(chrome, address) {
  await test("two blocks written by hand stand where they should, in their colours", async () => {
    const page = await open_page(chrome, address);
    await audited(page);
    await finished(page);
    await page.keyboard.press("i"); // no nozzles before the picture
    const nozzle = await page.evaluate(() => window.cleancolor.viewer.first.summary.nozzles.map((n) => n.colour.match(/[0-9a-f]{2}/gi).map((h) => parseInt(h, 16))));
    const [left, right] = nozzle;
    for (const [place, point, wanted] of [
      ["top of the left block", [48, 50, 5], left], ["top of the right block", [72, 50, 5], right],
      ["front of the left block", [48, 39.8, 2.5], left], ["front of the right block", [72, 39.8, 2.5], right],
    ]) {
      const seen = await colour_at(page, point);
      assert.ok(unlike(seen, wanted) < 0.1, `${place}: ${seen.map(Math.round)} is not like ${wanted}`);
    }
    for (const point of [[46, 28, 0.2], [72, 28, 0.2]]) {
      const bed = await colour_at(page, point);
      assert.ok(Math.max(...bed) - Math.min(...bed) < 40, `the bed beside is grey: ${bed.map(Math.round)}`);
    }
    await page.evaluate(() => window.cleancolor.viewer.go({ layer: 12 }));
    const cut = await page.evaluate(() => window.cleancolor.counts()[0]);
    assert.equal(cut.top, 2 * (4 + 49), "a layer has two outlines of four roads and 49 lines of infill in each");
    await picture(page, "known");
    assert.deepEqual(page.troubles, []);
    await page.context().close();
  });
}
