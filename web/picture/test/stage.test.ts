/** The outline of a mask runs between its pixels and all others. */

import { expect, test } from "vitest";

import { edges } from "../src/stage";

/** The runs of what is marked in a drawing. */
function runs(...rows: string[]): [number, number, number][] {
  return rows.flatMap((row, y) =>
    [...row.matchAll(/#+/g)].map(({ index, 0: run }): [number, number, number] => [y, index, index + run.length]),
  );
}

/** The outline's total length in pixel edges. */
function length(...rows: string[]): number {
  const mask = { width: 9, height: rows.length, runs: runs(...rows) };
  return edges(mask).reduce((sum, [x0, y0, x1, y1]) => sum + Math.abs(x1 - x0) + Math.abs(y1 - y0), 0);
}

test.each([
  [["#"], 4],
  [["###", "###"], 10],
  [["#.#", "###"], 12],
  [["###", "#.#", "###"], 16],
  [["##.##"], 12],
  [["..#", "#.."], 8],
  [["#####", ".#.#."], 16],
])("%j has %i edges", (rows, expected) => {
  expect(length(...rows)).toBe(expected);
});

test("a pixel's edges are its own", () => {
  const found = edges({ width: 9, height: 9, runs: [[2, 3, 4]] });
  expect(found.map(String).sort()).toEqual(["3,2,3,3", "3,2,4,2", "3,3,4,3", "4,2,4,3"]);
});
