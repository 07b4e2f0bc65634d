/** Where the picture lies in a pane of 400 x 200; it has 100 x 100 pixels. */

import { beforeEach, expect, test } from "vitest";

import { isInside, pixelAt, Viewport } from "../src/viewport";

let viewport: Viewport;

beforeEach(() => {
  viewport = new Viewport();
  viewport.setPane(400, 200);
  viewport.setPicture(100, 100);
});

test("it fits, and is in the middle", () => {
  expect(viewport.frame).toEqual({ x: 100, y: 0, width: 200, height: 200 });
  expect(viewport.scale).toBe(2);
});

test("it goes on fitting when the pane changes", () => {
  viewport.setPane(100, 200);
  expect(viewport.frame).toEqual({ x: 0, y: 50, width: 100, height: 100 });
});

test.each([
  [{ x: 150, y: 20 }, 3],
  [{ x: 299, y: 199 }, 0.5],
  [{ x: 200, y: 100 }, 10],
])("the point zoomed at stays: %j by %f", (point, factor) => {
  const before = viewport.fraction(point);
  viewport.zoomBy(factor, point);
  const after = viewport.fraction(point);
  expect(after.x).toBeCloseTo(before.x, 10);
  expect(after.y).toBeCloseTo(before.y, 10);
  expect(viewport.scale).toBeCloseTo(2 * factor, 10);
  expect(viewport.fitted).toBe(false);
});

test("it moves with the pointer", () => {
  viewport.zoomTo(4);
  const before = viewport.frame;
  viewport.moveBy(15, -7);
  expect(viewport.frame.x).toBeCloseTo(before.x + 15, 10);
  expect(viewport.frame.y).toBeCloseTo(before.y - 7, 10);
});

test("it cannot be lost", () => {
  viewport.zoomTo(4);
  viewport.moveBy(1e6, -1e6);
  expect(viewport.fraction({ x: 200, y: 100 })).toEqual({ x: 0, y: 1 });
  viewport.zoomTo(1e9);
  expect(viewport.scale).toBe(64);
  viewport.zoomTo(0);
  expect(viewport.scale).toBeGreaterThan(0);
  viewport.fit();
  expect(viewport.frame).toEqual({ x: 100, y: 0, width: 200, height: 200 });
});

test("a picture of any size has its pixels where the picture is", () => {
  const size = { width: 50, height: 50 };
  for (const [point, pixel] of [
    [{ x: 100, y: 0 }, { x: 0, y: 0 }],
    [{ x: 299.9, y: 199.9 }, { x: 49, y: 49 }],
    [{ x: 204, y: 4 }, { x: 26, y: 1 }],
  ] as const) {
    const place = viewport.fraction(point);
    expect(isInside(place)).toBe(true);
    expect(pixelAt(place, size)).toEqual({ ...pixel, ...size });
  }
  for (const point of [{ x: 99, y: 50 }, { x: 300, y: 50 }, { x: 150, y: 200 }]) {
    expect(isInside(viewport.fraction(point))).toBe(false);
  }
});
