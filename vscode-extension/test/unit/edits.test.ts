/** Places are followed through edits: what they point at is the same before and after. */

import { expect, test } from "vitest";

import { Edits, type Change, type Place } from "../../src/edits";

const SCENE = "SOLID\n{\n    SPHERE { RADIUS 2 }\n}\nLIGHT { }\n";

/** Where a word begins. */
function place(text: string, word: string): Place {
  return placeAt(text, text.indexOf(word));
}

function placeAt(text: string, at: number): Place {
  const before = text.slice(0, at).split("\n");
  return { line: before.length - 1, character: before[before.length - 1]?.length ?? 0 };
}

function offset(text: string, { line, character }: Place): number {
  const lines = text.split("\n").slice(0, line);
  return lines.reduce((sum, one) => sum + one.length + 1, 0) + character;
}

/** The changes of one edit, each of which replaces a word, and the text after them. */
function edit(text: string, ...replacements: [string, string][]): { changes: Change[]; text: string } {
  const changes = replacements.map(([word, by]) => {
    const at = text.indexOf(word);
    return { range: { start: placeAt(text, at), end: placeAt(text, at + word.length) }, text: by };
  });
  const last = [...changes].sort((one, other) => offset(text, other.range.start) - offset(text, one.range.start));
  const result = last.reduce(
    (now, { range, text: by }) => now.slice(0, offset(text, range.start)) + by + now.slice(offset(text, range.end)),
    text,
  );
  return { changes, text: result };
}

test.each([
  ["a longer word before it on its line", [["RADIUS", "CENTER < 0, 0, 2 > RADIUS"]]],
  ["lines before it", [["SOLID", "VARIABLES\n{\n    NUMBER x;\n}\n\nSOLID"]]],
  ["lines before it on its line", [["SPHERE", "\n\n  SPHERE"]]],
  ["fewer lines before it", [["{\n    SPHERE", "{ SPHERE"]]],
  ["text after it", [["LIGHT", "LIGHT lamp"]]],
  [
    "several at once",
    [
      ["LIGHT", "LIGHT lamp"],
      ["SOLID", "SOLID ball"],
      ["RADIUS", "\n        RADIUS"],
    ],
  ],
] as [string, [string, string][]][])("a place stays at its word after %s", (_, replacements) => {
  const after = edit(SCENE, ...replacements);
  const edits = new Edits();
  edits.add(2, after.changes);
  for (const word of ["2 }", "}\nLIGHT", "{ }"]) {
    const then = place(SCENE, word);
    const now = edits.toNow(1, then);
    expect(after.text.slice(offset(after.text, now))[0]).toBe(word[0]);
    expect(edits.toThen(1, now)).toEqual(then);
  }
});

test("a place within what was replaced goes to its beginning", () => {
  const edits = new Edits();
  edits.add(2, edit(SCENE, ["SPHERE { RADIUS 2 }", "PLANE { }"]).changes);
  expect(edits.toNow(1, place(SCENE, "RADIUS"))).toEqual(place(SCENE, "SPHERE"));
});

test("only the edits since the version count", () => {
  const edits = new Edits();
  const start = { line: 0, character: 0 };
  edits.add(2, [{ range: { start, end: start }, text: "\n" }]);
  edits.add(3, [{ range: { start, end: start }, text: "\n\n" }]);
  expect(edits.toNow(1, { line: 4, character: 1 }).line).toBe(7);
  expect(edits.toNow(2, { line: 4, character: 1 }).line).toBe(6);
  expect(edits.toNow(3, { line: 4, character: 1 }).line).toBe(4);
  expect(edits.toThen(1, { line: 7, character: 1 }).line).toBe(4);
});
