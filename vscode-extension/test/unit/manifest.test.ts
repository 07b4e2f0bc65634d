/** package.json and the code say the same: commands, settings, files. */

import * as fs from "node:fs";
import * as path from "node:path";
import { expect, test } from "vitest";

import language from "../../language-configuration.json" with { type: "json" };
import manifest from "../../package.json" with { type: "json" };

const ROOT = path.join(import.meta.dirname, "../..");
const SOURCES = fs
  .readdirSync(path.join(ROOT, "src"), { recursive: true, encoding: "utf8" })
  .filter((name) => name.endsWith(".ts"))
  .map((name) => fs.readFileSync(path.join(ROOT, "src", name), "utf8"))
  .join("\n");

test("every command is there; people see all but those of the status item and of a code lens", () => {
  const registered = [...SOURCES.matchAll(/(?:registerCommand|command)\("(m3d\.[\w.]+)"/g)].map((found) => found[1]);
  const contributed = manifest.contributes.commands.map(({ command }) => command);
  expect([...contributed, "m3d.status", "m3d.showReferences"].sort()).toEqual([...registered].sort());
});

test("every command that a menu, a key or a step names is there", () => {
  const commands = new Set(manifest.contributes.commands.map(({ command }) => command));
  const named = JSON.stringify([
    manifest.contributes.menus,
    manifest.contributes.keybindings,
    manifest.contributes.walkthroughs,
  ]).matchAll(/(?:"command":"|command:|onCommand:)(m3d\.[\w.]+)/g);
  for (const [, command] of named) {
    expect(commands).toContain(command);
  }
});

test("the defaults in the code are those of the settings", () => {
  const settings: Record<string, { default: unknown }> = manifest.contributes.configuration.properties;
  const read = [...SOURCES.matchAll(/settings\.get<[^(]*>\("(\w+)", ([^)]+)\)/g)];
  expect(read.length).toBeGreaterThan(4);
  for (const [, name = "", value = ""] of read) {
    expect(settings[`m3d.preview.${name}`]?.default, name).toEqual(JSON.parse(value));
  }
});

test("who types the project's name finds every command", () => {
  expect(new Set(manifest.contributes.commands.map(({ category }) => category))).toEqual(new Set(["Mirage3D"]));
});

test("the views say what is the matter, whatever the server does", () => {
  for (const { id } of manifest.contributes.views.m3d) {
    const states = manifest.contributes.viewsWelcome.filter(({ view }) => view === id).map(({ when }) => when);
    for (const state of ["starting", "missing", "failed"]) {
      expect(states.filter((when) => when.includes(`m3d.server == ${state}`)).length, state).toBe(1);
    }
  }
});

test("what is typed by hand has one end", () => {
  for (const { open, close } of language.autoClosingPairs) {
    expect([open, close].map(({ length }) => length)).toEqual([1, 1]);
  }
});

test("the extension's page shows no pictures that it cannot show", () => {
  const page = fs.readFileSync(path.join(ROOT, "README.md"), "utf8");
  for (const [, address = ""] of page.matchAll(/!?\[[^\]]*\]\(([^)]+)\)/g)) {
    expect(address).toMatch(/^https:/);
  }
});

test("every file that is named is there", () => {
  const folders = "icons|images|snippets|syntaxes|walkthrough";
  const files = JSON.stringify(manifest.contributes).matchAll(new RegExp(`"((?:\\./)?(?:${folders})/[^"]+)"`, "g"));
  for (const [, file = ""] of files) {
    expect(fs.existsSync(path.join(ROOT, file)), file).toBe(true);
  }
});
