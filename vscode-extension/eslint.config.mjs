import { defineConfig } from "eslint/config";
import tseslint from "typescript-eslint";

import { rules } from "../web/picture/eslint.rules.mjs";

export default defineConfig(
  { ignores: ["dist/", "node_modules/", "*.mjs", "vitest.config.ts"] },
  tseslint.configs.strictTypeChecked,
  tseslint.configs.stylisticTypeChecked,
  {
    languageOptions: {
      parserOptions: { project: ["tsconfig.json", "webview/tsconfig.json", "test/e2e/tsconfig.json"] },
    },
    rules,
  },
);
