// node tests/page/viewer_picture.mjs print.gcode picture.png: the viewer's page with a print, one of its defects selected.
// Called by scripts/pictures.
import path from "node:path";
import { audited, browser, finished, open_page, serve, settled } from "./harness.mjs";

const [print, picture] = process.argv.slice(2).map((name) => path.resolve(name));
const server = await serve([print, "--printer", "replicator-dual"]);
const chrome = await browser();
try {
  const page = await open_page(chrome, server.address, { viewport: { width: 1040, height: 576 }, colorScheme: "light", reducedMotion: "reduce" });
  await audited(page);
  await finished(page);
  await page.locator("#defects button").nth(1).click(); // halfway up the globe, unlike the worst
  await finished(page);
  await page.mouse.move(0, 0);
  await settled(page);
  await page.screenshot({ path: picture });
} finally {
  await chrome.close();
  server.end();
}
process.exit(0);
