/** Where there can be no picture it is said why, and each thing that can be done is a command that there is. */

import { expect, test } from "vitest";

import manifest from "../../package.json" with { type: "json" };
import { commandOf, COMMANDS, obstacle } from "../../src/actions";
import type { ServerState } from "../../src/server";

const RUNNING: ServerState = { kind: "running", program: "/usr/bin/m3d-lsp", version: "" };

test.each([
  [{ kind: "starting" }, true, /is starting/],
  [{ kind: "missing", looked: [] }, true, /was not found.*m3d\.server\.path/],
  [{ kind: "failed", reason: "It ended." }, true, /^It ended\.$/],
  [RUNNING, false, /Restricted Mode/],
] as [ServerState, boolean, RegExp][])("%j, trusted: %s", (state, trusted, reason) => {
  const found = obstacle(state, trusted);
  expect(found?.reason).toMatch(reason);
  expect(found?.actions.length).toBeGreaterThan(0);
  expect(found?.actions.every((action) => commandOf(action) !== undefined)).toBe(true);
});

test("while it runs nothing is in the way", () => {
  expect(obstacle(RUNNING, true)).toBeNull();
});

test("the commands are the extension's own or VS Code's; nothing else can be asked for", () => {
  const own = manifest.contributes.commands.map(({ command }) => command);
  for (const command of Object.values(COMMANDS)) {
    expect(own.includes(command) || command.startsWith("workbench."), command).toBe(true);
  }
  expect(commandOf("workbench.action.quit")).toBeUndefined();
  expect(commandOf("toString")).toBeUndefined();
});
