import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    projects: [
      { test: { name: "extension", include: ["test/{unit,grammar}/*.test.ts"] } },
      { test: { name: "preview", include: ["test/preview/*.test.ts"], environment: "happy-dom" } },
    ],
  },
});
