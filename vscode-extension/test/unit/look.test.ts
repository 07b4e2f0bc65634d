/** The status item says what the server is doing, and what to do when it is not. */

import { expect, test } from "vitest";

import { look } from "../../src/look";

test("while it runs, which program it is", () => {
  const running = look({ kind: "running", program: "/usr/bin/m3d-lsp", version: "0.1.0" }, true);
  expect(running.tooltip).toBe("/usr/bin/m3d-lsp 0.1.0");
  expect(running.color).toBeUndefined();
});

test("in a workspace that is not trusted, that nothing is rendered", () => {
  const { label } = look({ kind: "running", program: "/usr/bin/m3d-lsp", version: "" }, false);
  expect(label).toContain("Restricted Mode: nothing is rendered.");
});

test("when it is missing, where it was looked for and what to do", () => {
  const { tooltip, color } = look({ kind: "missing", looked: ["/projects/.venv/bin/m3d-lsp"] }, true);
  expect(tooltip).toContain("/projects/.venv/bin/m3d-lsp");
  expect(tooltip).toContain("m3d.server.path");
  expect(color).toBe("statusBarItem.warningBackground");
});

test("when it has failed, why", () => {
  expect(look({ kind: "failed", reason: "It ended." }, true).label).toBe("Mirage3D: It ended.");
});
