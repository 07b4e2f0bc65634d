/** What the TextMate grammar makes of scenes; `vitest run -u` writes the expected tokens anew. */

import * as fs from "node:fs";
import { createRequire } from "node:module";
import * as path from "node:path";
import { expect, test } from "vitest";
import oniguruma from "vscode-oniguruma";
import textmate, { type IGrammar } from "vscode-textmate";

const HERE = import.meta.dirname;
const GRAMMAR = path.join(HERE, "../../syntaxes/m3d.tmLanguage.json");
const EXAMPLES = path.join(HERE, "../../../examples");

async function grammar(): Promise<IGrammar> {
  const wasm = createRequire(import.meta.url).resolve("vscode-oniguruma/release/onig.wasm");
  await oniguruma.loadWASM(fs.readFileSync(wasm));
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => oniguruma.createOnigScanner(patterns),
      createOnigString: (text) => oniguruma.createOnigString(text),
    }),
    loadGrammar: () => Promise.resolve(textmate.parseRawGrammar(fs.readFileSync(GRAMMAR, "utf8"), GRAMMAR)),
  });
  const loaded = await registry.loadGrammar("source.m3d");
  if (loaded === null) {
    throw new Error("the grammar cannot be read");
  }
  return loaded;
}

const m3d = await grammar();

/** For each line the text of its tokens, without blanks, and their innermost scopes. */
function tokens(text: string): [string, string][][] {
  let state = textmate.INITIAL;
  return text.split("\n").map((line) => {
    const tokenized = m3d.tokenizeLine(line, state);
    state = tokenized.ruleStack;
    return tokenized.tokens
      .map(({ startIndex, endIndex, scopes }): [string, string] => [
        line.slice(startIndex, endIndex).trim(),
        scopes[scopes.length - 1]?.replace(/\.m3d$/, "") ?? "",
      ])
      .filter(([word]) => word !== "");
  });
}

/** The innermost scope of a word where it stands first. */
function scope(text: string, word: string): string | undefined {
  return tokens(text)
    .flat()
    .find(([token]) => token === word)?.[1];
}

test("a scene, token by token", async () => {
  const scene = fs.readFileSync(path.join(HERE, "scene.m3d"), "utf8");
  const lines = tokens(scene).map((line, index) => {
    const list = line.map(([word, name]) => `    ${word.padEnd(14)} ${name}`.trimEnd());
    return [scene.split("\n")[index] ?? "", ...list].join("\n");
  });
  await expect(`${lines.join("\n").trimEnd()}\n`).toMatchFileSnapshot(path.join(HERE, "scene.tokens"));
});

test.each([
  "/* one */ SCENE",
  "/* one /* two */ still one */ SCENE",
  "/* /* /* three */ */ */ SCENE",
  "/* begun /* nested\n   and */ ended */ SCENE",
  "/*/* */*/ SCENE",
  "/* ** / */ SCENE",
])("comments nest: %j", (text) => {
  const code = tokens(text)
    .flat()
    .filter(([, name]) => !name.includes("comment"));
  expect(code).toEqual([["SCENE", "storage.type.block"]]);
});

test("a comment that is not closed reaches to the end", () => {
  expect(tokens("/* /* */ SCENE\nSOLID").flat().some(([, name]) => name.startsWith("storage"))).toBe(false);
});

test.each([
  ["AMBIENT { INTENSITY 0.2 }", "storage.type.block"],
  ["AMBIENT /* light */ { }", "storage.type.block"],
  ["AMBIENT\n{\n}", "storage.type.block"],
  ["AMBIENT 0.1", "support.type.property-name"],
  ["AMBIENT amount", "support.type.property-name"],
])("AMBIENT is a block or a property: %j", (text, expected) => {
  expect(scope(text, "AMBIENT")).toBe(expected);
});

test.each(["3", "-0.5", "+.5", "1.0e10", "1E-5", "1.2.3", "0x10"])("a number: %s", (number) => {
  expect(tokens(`RADIUS ${number}`).flat()).toContainEqual([number, "constant.numeric"]);
});

test.each(["ball", "SPHERE2", "sphere", "Sphere_1", "xSPHERE"])("a name: %s", (name) => {
  expect(tokens(`${name} = 1`).flat()[0]).toEqual([name, "variable.other"]);
});

test.each(fs.readdirSync(EXAMPLES).filter((name) => name.endsWith(".m3d")))("%s is coloured throughout", (name) => {
  const plain = tokens(fs.readFileSync(path.join(EXAMPLES, name), "utf8"))
    .flat()
    .filter(([, scope]) => scope === "source");
  expect(plain).toEqual([]);
});
