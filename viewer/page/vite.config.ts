// The page that `cleancolor view` serves, and the script of the report, in one call of `vite build`. The page has
// nothing inline, for its content security policy is default-src 'self'.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { build, defineConfig, type Plugin } from "vite";

/** The report has a style of its own: what is for the whole page here is for the viewer's element there. */
const within = (selector: string) =>
  selector.startsWith(".report") ? `#cleancolor-report${selector}` :
  /^(:root|html|body)$/.test(selector) ? "#cleancolor-report" : `#cleancolor-report ${selector}`;
const report_style = {
  postcssPlugin: "report-style",
  Once(sheet: { walkRules: (change: (rule: { selectors: string[] }) => void) => void }) {
    sheet.walkRules((rule) => { rule.selectors = rule.selectors.map(within); });
  },
};

/**
 * One script and one style sheet that the program writes into the HTML file of a report; and report.sha256, by which the
 * file's content security policy knows the script. So the script is made here as it will stand there.
 */
const report = (): Plugin => {
  let folder = "";
  return {
    name: "report", apply: "build",
    configResolved(config) { folder = resolve(config.root, config.build.outDir); },
    async closeBundle() {
      await build({
        configFile: false, logLevel: "warn", css: { postcss: { plugins: [report_style] } },
        build: {
          outDir: folder, emptyOutDir: false, target: "es2022", copyPublicDir: false, chunkSizeWarningLimit: 900,
          lib: { entry: "report.ts", formats: ["iife"], name: "cleancolor_report", fileName: () => "report.js", cssFileName: "report" },
        },
      });
      const file = resolve(folder, "report.js");
      const script = readFileSync(file, "utf8").trim().replace(/<\/(?=script)/gi, "<\\/");
      if (script.includes("<!--")) throw new Error("report.js holds <!--, which a script in an HTML file must not");
      writeFileSync(file, script);
      writeFileSync(resolve(folder, "report.sha256"), createHash("sha256").update(script).digest("base64"));
    },
  };
};

export default defineConfig({
  base: "./",
  build: { outDir: "../../build/page", emptyOutDir: true, target: "es2022", assetsInlineLimit: 0, modulePreload: { polyfill: false }, chunkSizeWarningLimit: 900 },
  plugins: [report()],
});
