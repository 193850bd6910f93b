// The page that `cleancolor view` serves, and the script of the report, in one call of `vite build`. The page has
// nothing inline, for its content security policy is default-src 'self'.
import { resolve } from "node:path";
import { build, defineConfig, type Plugin } from "vite";

/** One script and one style sheet that the program writes into the HTML file of a report. */
const report = (): Plugin => {
  let folder = "";
  return {
    name: "report", apply: "build",
    configResolved(config) { folder = resolve(config.root, config.build.outDir); },
    async closeBundle() {
      await build({
        configFile: false, logLevel: "warn",
        build: {
          outDir: folder, emptyOutDir: false, target: "es2022", copyPublicDir: false, chunkSizeWarningLimit: 900,
          lib: { entry: "report.ts", formats: ["iife"], name: "cleancolor_report", fileName: () => "report.js", cssFileName: "report" },
        },
      });
    },
  };
};

export default defineConfig({
  base: "./",
  build: { outDir: "../../build/page", emptyOutDir: true, target: "es2022", assetsInlineLimit: 0, modulePreload: { polyfill: false }, chunkSizeWarningLimit: 900 },
  plugins: [report()],
});
