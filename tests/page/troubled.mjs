// One print that cannot be read, or not audited, leaves the page with the others, and the page says why.
import assert from "node:assert/strict";
import path from "node:path";
import { audited, open_page, out, picture, test } from "./harness.mjs";

const names = (page) => page.evaluate(() => window.cleancolor.viewer.sides.map((s) => s.name));
const status = (page) => page.locator(".status").textContent();

export async function troubled(chrome, address) {
  await test("a file that cannot be read does not hide one that can, and the page says why", async () => {
    const page = await open_page(chrome, address);
    await audited(page);
    assert.deepEqual(await names(page), ["blocks.gcode"]);
    const row = page.locator("#unread li");
    await row.waitFor({ state: "visible" });
    assert.match(await row.locator("span").textContent(), /^bad\.gcode: .{10}/);
    await picture(page, "unread");
    assert.equal(await page.locator("#print").inputValue(), "1");
    assert.deepEqual(page.troubles, []);
    await page.context().close();
  });

  await test("a file that turns out to be unreadable while others are looked at is listed, too", async () => {
    let read = false;
    const page = await open_page(chrome, address, {}, (page) => page.route("**/api/prints", async (route) => {
      const rows = await (await route.fetch()).json();
      await route.fulfill({ json: read ? rows : rows.map(({ id, name, error, ...row }) => (error ? { id, name, state: "reading" } : { id, name, ...row })) });
    }));
    await audited(page);
    const row = page.locator("#unread li");
    assert.equal(await row.count(), 0);
    read = true;
    await row.waitFor({ state: "visible" });
    assert.match(await row.locator("span").textContent(), /^bad\.gcode: .{10}/);
    await page.context().close();
  });

  await test("one print that fails as another comes is noticed, and that the program once does not answer", async () => {
    let asked = 0, others = null;
    const page = await open_page(chrome, address, {}, (page) => page.route("**/api/prints", async (route) => {
      asked++;
      if (others && others.failing-- > 0) { await route.abort(); return; }
      const rows = (await (await route.fetch()).json()).filter((row) => row.name === "blocks.gcode");
      await route.fulfill({ json: [...rows, ...(others ? others.rows : [{ id: 77, name: "late.gcode", state: "reading" }])] });
    }));
    await audited(page);
    assert.deepEqual(await page.locator("#print option").allTextContents(), ["blocks.gcode", "late.gcode"]);
    others = { failing: 2, rows: [{ id: 77, name: "late.gcode", state: "failed", error: "no move in it" }, { id: 78, name: "new.gcode", state: "drawn" }] };
    await page.waitForFunction(() => [...document.querySelectorAll("#print option")].map((o) => o.textContent).join() === "blocks.gcode,new.gcode");
    assert.match(await page.locator("#unread li span").textContent(), /^late\.gcode: no move in it/);
    assert.ok(asked >= 4);
    await page.context().close();
  });

  await test("a print that fails only in the audit is shown without it", async () => {
    const failed = { state: "failed", error: "out of memory" };
    const page = await open_page(chrome, address, {}, async (page) => {
      await page.route("**/api/prints", async (route) => {
        const rows = await (await route.fetch()).json();
        await route.fulfill({ json: rows.map((row) => ({ ...row, ...failed })) });
      });
      await page.route("**/api/prints/1", async (route) => {
        const print = await (await route.fetch()).json();
        await route.fulfill({ json: print.summary ? { ...print, ...failed } : print });
      });
    });
    await page.waitForFunction(() => window.cleancolor?.viewer.first?.trouble);
    assert.deepEqual(await names(page), ["blocks.gcode"]);
    await page.locator(".status", { hasText: "blocks.gcode: out of memory" }).waitFor({ state: "visible" });
    assert.match(await page.locator("#pane-defects .note").textContent(), /out of memory/);
    assert.deepEqual(await page.locator("#print option").allTextContents(), ["blocks.gcode"]);
    await page.context().close();
  });

  await test("what is wrong with a print is not told when another is open by then", async () => {
    const page = await open_page(chrome, address);
    await audited(page);
    const said = await page.evaluate(async () => {
      const { viewer } = window.cleancolor, said = [], { source } = viewer.first;
      const late = { drawn: () => new Promise((_, refuse) => setTimeout(() => refuse(new Error("too late")), 200)) };
      const first = viewer.open([{ name: "late", source: late }], (text) => said.push(text)).catch((e) => said.push(e.message));
      await Promise.all([first, viewer.open([{ name: "next", source }], () => undefined)]);
      return said;
    });
    assert.deepEqual(said, []);
    assert.deepEqual(await names(page), ["next"]);
    await page.context().close();
  });

  await test("a print forgotten is gone from the program, and the next is shown, or how to open one", async () => {
    const page = await open_page(chrome, address);
    await audited(page);
    await page.setInputFiles("#file", path.join(out, "protected.gcode"));
    await page.waitForFunction(() => window.cleancolor.viewer.first?.name === "protected.gcode");
    await audited(page);
    let asked = "";
    page.on("dialog", (d) => { asked = d.message(); void d.accept(); });
    await page.click("#forget");
    await page.waitForFunction(() => window.cleancolor.viewer.first?.name === "blocks.gcode");
    assert.match(asked, /^Forget protected\.gcode\?/);
    await audited(page);
    await page.click("#forget");
    await page.waitForFunction(() => window.cleancolor.viewer.sides.length === 0);
    assert.ok(await page.locator(".welcome").isVisible());
    assert.ok(!(await page.locator("#forget").isVisible()));
    const left = await (await page.request.get(new URL("/api/prints", address).href)).json();
    assert.deepEqual(left.map((p) => p.name), ["bad.gcode"]);
    await page.locator("#unread button").click();
    await page.locator("#unread").waitFor({ state: "hidden" });
    assert.deepEqual(await (await page.request.get(new URL("/api/prints", address).href)).json(), []);
    await page.setInputFiles("#file", path.join(out, "bad.gcode"));
    await page.locator("#unread li").waitFor({ state: "visible" });
    await page.locator(".status", { hasText: "bad.gcode" }).waitFor({ state: "visible" }); // it may be listed before
    await page.locator("#unread button").click();
    await page.locator("#unread").waitFor({ state: "hidden" });
    assert.ok(!(await page.locator(".status").isVisible()), "what was wrong with it goes with it");
    assert.deepEqual(page.troubles, []);
    await page.context().close();
  });
}
