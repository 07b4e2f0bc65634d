import { defineConfig } from "eslint/config";
import tseslint from "typescript-eslint";

import { rules } from "./eslint.rules.mjs";

export default defineConfig(
  { ignores: ["dist/", "node_modules/", "test/page/", "*.mjs", "vitest.config.ts"] },
  tseslint.configs.strictTypeChecked,
  tseslint.configs.stylisticTypeChecked,
  { languageOptions: { parserOptions: { project: ["tsconfig.json"] } }, rules },
);
