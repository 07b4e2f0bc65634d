/** The server is looked for in the setting, the workspace and the path, in this order. */

import { expect, test } from "vitest";

import { findProgram, findServer, type Surroundings } from "../../src/programs";

function around(files: string[], changes: Partial<Surroundings> = {}): Surroundings {
  return {
    setting: "",
    folders: ["/projects/scenes"],
    trusted: true,
    path: "/usr/local/bin:/usr/bin:relative",
    home: "/home/ann",
    windows: false,
    runnable: (file) => files.includes(file),
    ...changes,
  };
}

const VENV = "/projects/scenes/.venv/bin/m3d-lsp";
const PATH = "/usr/bin/m3d-lsp";

test.each([
  ["the workspace's before the path's", [VENV, PATH], {}, { program: VENV, where: "workspace" }],
  ["the path's", [PATH], {}, { program: PATH, where: "path" }],
  ["the setting's before all", [VENV, "/opt/lsp"], { setting: "/opt/lsp" }, { program: "/opt/lsp", where: "setting" }],
  ["home", ["/home/ann/lsp"], { setting: "~/lsp" }, { program: "/home/ann/lsp", where: "setting" }],
  ["relative to the workspace", [VENV], { setting: ".venv/bin/m3d-lsp" }, { program: VENV, where: "setting" }],
  [
    "a folder by name",
    [VENV],
    { setting: "${workspaceFolder}/.venv/bin/m3d-lsp" },
    { program: VENV, where: "setting" },
  ],
  ["an untrusted workspace's is not run", [VENV, PATH], { trusted: false }, { program: PATH, where: "path" }],
] as [string, string[], Partial<Surroundings>, object][])("found: %s", (_, files, changes, expected) => {
  expect(findServer(around(files, changes))).toEqual(expected);
});

test("where one has looked is told", () => {
  expect(findServer(around([]))).toEqual({ looked: [VENV, "the folders of PATH"] });
  expect(findServer(around([], { trusted: false }))).toEqual({ looked: ["the folders of PATH"] });
});

test("what was asked for by name is not replaced by another", () => {
  const found = findServer(around([VENV, PATH], { setting: "/opt/lsp" }));
  expect(found).toEqual({ looked: ["/opt/lsp (the setting m3d.server.path)"] });
});

test("a folder of the path that is not absolute would depend on where one stands", () => {
  expect(findServer(around(["relative/m3d-lsp"]))).toHaveProperty("looked");
});

test("the other programs are beside the server, else on the path", () => {
  const files = [VENV, "/projects/scenes/.venv/bin/m3dc", "/usr/bin/m3dc", "/usr/bin/m3d-render"];
  const surroundings = around(files);
  const server = findServer(surroundings);
  expect(findProgram("m3dc", server, surroundings)).toBe("/projects/scenes/.venv/bin/m3dc");
  expect(findProgram("m3d-render", server, surroundings)).toBe("/usr/bin/m3d-render");
  expect(findProgram("m3dfmt", server, surroundings)).toBe("m3dfmt");
});
