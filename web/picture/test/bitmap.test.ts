/** Tiles become a picture, whatever their step. */

import { expect, test } from "vitest";

import { Bitmap } from "../src/bitmap";
import type { Tile } from "../src/host";

/** A tile of one colour for each letter of its rows. */
function tile(width: number, height: number, top: number, step: number, ...rows: string[]): Tile {
  const columns = rows[0]?.length ?? 0;
  const pixels = Uint8Array.from(rows.join("").split("").flatMap((letter) => [letter.charCodeAt(0), 0, 255]));
  return { preview: "", version: 1, width, height, top, step, columns, rows: rows.length, pixels };
}

/** The picture as the letters of its red values; a dot where there is nothing. */
function shown(bitmap: Bitmap): string[] {
  return Array.from({ length: bitmap.height }, (_, y) =>
    Array.from({ length: bitmap.width }, (_, x) => {
      const color = bitmap.color(x, y);
      return color === null ? "." : String.fromCharCode(Math.round(color[0] * 255));
    }).join(""),
  );
}

test("a coarse tile covers squares, and is cut at the picture's edges", () => {
  const bitmap = new Bitmap(5, 3);
  bitmap.paint(tile(5, 3, 0, 2, "abc", "def"));
  expect(shown(bitmap)).toEqual(["aabbc", "aabbc", "ddeef"]);
});

test("a finer one replaces what it covers", () => {
  const bitmap = new Bitmap(4, 4);
  bitmap.paint(tile(4, 4, 0, 4, "a"));
  bitmap.paint(tile(4, 4, 2, 2, "bc"));
  bitmap.paint(tile(4, 4, 3, 1, "wxyz"));
  expect(shown(bitmap)).toEqual(["aaaa", "aaaa", "bbcc", "wxyz"]);
});

test("the progress counts pixels", () => {
  const bitmap = new Bitmap(4, 4);
  expect(bitmap.progress).toBe(0);
  bitmap.paint(tile(4, 4, 0, 4, "a"));
  expect(bitmap.progress).toBe(1 / 16);
  bitmap.paint(tile(4, 4, 0, 1, "abcd", "abcd"));
  expect(bitmap.progress).toBe((2 + 2 / 16) / 4);
});

test("a new picture begins with the one before, at its size", () => {
  const before = new Bitmap(2, 1);
  before.paint(tile(2, 1, 0, 1, "ab"));
  const bitmap = Bitmap.over(before, 4, 2);
  expect(shown(bitmap)).toEqual(["aabb", "aabb"]);
  expect(bitmap.progress).toBe(0);
  expect(shown(before)).toEqual(["ab"]);
});

test("there is no colour outside", () => {
  const bitmap = new Bitmap(1, 1);
  bitmap.paint(tile(1, 1, 0, 1, "a"));
  expect(bitmap.color(0, 0)).toEqual([97 / 255, 0, 1]);
  for (const [x, y] of [[-1, 0], [1, 0], [0, 1]] as const) {
    expect(bitmap.color(x, y)).toBeNull();
  }
});

test("pixels may be base64, as they come in JSON", () => {
  const bitmap = new Bitmap(2, 1);
  bitmap.paint({ ...tile(2, 1, 0, 1, "ab"), pixels: btoa("a\x00\xffb\x00\xff") });
  expect(shown(bitmap)).toEqual(["ab"]);
  expect(bitmap.color(1, 0)).toEqual([98 / 255, 0, 1]);
});
