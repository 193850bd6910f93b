// The report's script draws a print that stands in the same file: made here from the server's answers, opened as a file.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { deflateSync } from "node:zlib";
import { audited, finished, open_page, out, picture, root, test } from "./harness.mjs";

export async function report(chrome, address) {
  await test("a report in one file draws its print without a server", async () => {
    const page = await open_page(chrome, address);
    await audited(page);
    const get = async (what) => (await page.request.get(new URL(`/api/prints/1${what}`, address).href)).body();
    const summary = JSON.parse((await get("")).toString()).summary;
    const built = (name) => readFileSync(path.join(root, "build/page", name), "utf8").replace(/<\/script/gi, "<\\/script");
    const data = async (what) => `<script type="application/octet-stream" id="cleancolor-0-${what}" data-encoding="deflate">${deflateSync(await get(`/${what}`)).toString("base64")}</script>`;
    const file = path.join(out, "report.html");
    writeFileSync(file, `<!doctype html><html lang="en"><meta charset="utf-8"><title>report</title><style>${built("report.css")}</style><body><div id="cleancolor-report"></div>
<script type="application/json" id="cleancolor-0-summary">${JSON.stringify(summary).replace(/</g, "\\u003c")}</script>${await data("moves")}${await data("audit")}<script>${built("report.js")}</script></body></html>`);
    await page.context().close();
    const alone = await open_page(chrome, `file://${file}`);
    await audited(alone);
    await finished(alone);
    assert.equal(await alone.evaluate(() => window.cleancolor.counts()[0].moves), summary.moves);
    await alone.locator("#defects button").first().click();
    await picture(alone, "report");
    assert.deepEqual(alone.troubles, []);
    await alone.context().close();
  });
}
