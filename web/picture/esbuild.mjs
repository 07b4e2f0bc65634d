// Bundles the picture part into dist/: picture.js, a module that any page can import, and picture.css.

import { build } from "esbuild";

await build({
  bundle: true,
  minify: true,
  legalComments: "none",
  logLevel: "warning",
  entryPoints: [
    { in: "src/preview.ts", out: "picture" },
    { in: "src/style.css", out: "picture" },
  ],
  outdir: "dist",
  platform: "browser",
  format: "esm",
  target: "es2022",
});
