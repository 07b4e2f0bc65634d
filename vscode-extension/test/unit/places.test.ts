/** Of nested places the narrowest is meant. */

import { expect, test } from "vitest";

import type { Span } from "../../src/edits";
import { holds, narrowest, same } from "../../src/places";

function range(line: number, character: number, endLine: number, end: number): Span {
  return { start: { line, character }, end: { line: endLine, character: end } };
}

const SOLID = range(0, 0, 5, 1);
const SPHERE = range(2, 4, 2, 30);
const RADIUS = range(2, 13, 2, 21);

test.each([
  [0, 3, SOLID],
  [2, 5, SPHERE],
  [2, 13, RADIUS],
  [2, 21, RADIUS],
  [2, 22, SPHERE],
  [5, 1, SOLID],
  [5, 2, undefined],
])("at %i:%i", (line, character, expected) => {
  const ranges = [SOLID, null, RADIUS, undefined, SPHERE];
  expect(ranges[narrowest(ranges, { line, character })]).toBe(expected);
});

test("of equal ranges it is the first", () => {
  expect(narrowest([range(1, 0, 1, 9), range(1, 0, 1, 9)], { line: 1, character: 4 })).toBe(0);
});

test("a range holds its ends", () => {
  expect(holds(SPHERE, { line: 2, character: 4 })).toBe(true);
  expect(holds(SPHERE, { line: 2, character: 30 })).toBe(true);
  expect(holds(SPHERE, { line: 2, character: 3 })).toBe(false);
});

test("ranges are the same by their numbers", () => {
  expect(same(SPHERE, range(2, 4, 2, 30))).toBe(true);
  expect(same(SPHERE, range(2, 4, 3, 30))).toBe(false);
  expect(same(SPHERE, null)).toBe(false);
  expect(same(null, undefined)).toBe(true);
});
