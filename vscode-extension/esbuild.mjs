// Bundles the extension and the page of its preview into dist/. `--watch` goes on doing so, `--e2e FOLDER` bundles the
// end-to-end tests instead.

import { build, context } from "esbuild";

const common = { bundle: true, minify: true, sourcemap: false, legalComments: "none", logLevel: "warning" };

const extension = {
  ...common,
  entryPoints: { extension: "src/extension.ts" },
  outdir: "dist",
  platform: "node",
  format: "cjs",
  target: "node18",
  external: ["vscode"],
};

const page = {
  ...common,
  entryPoints: { preview: "webview/main.ts" },
  outdir: "dist",
  platform: "browser",
  format: "iife",
  target: "es2022",
};

const endToEnd = (folder) => ({
  ...common,
  minify: false,
  entryPoints: ["editing", "restricted", "server"].map((name) => `test/e2e/${name}.test.ts`),
  outdir: folder,
  platform: "node",
  format: "esm",
  outExtension: { ".js": ".mjs" },
  target: "node20",
  external: ["playwright-core"],
});

const at = process.argv.indexOf("--e2e");
if (at > 0) {
  await build(endToEnd(process.argv[at + 1]));
} else if (process.argv.includes("--watch")) {
  await Promise.all([extension, page].map(async (options) => (await context(options)).watch()));
} else {
  await Promise.all([extension, page].map((options) => build(options)));
}
