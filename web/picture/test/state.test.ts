/** What is said of a picture: the one thing that matters most. */

import { expect, test } from "vitest";

import type { Hit } from "../src/host";
import { hitText, pixelText } from "../src/readout";
import { badge, type State } from "../src/state";

const CURRENT: State = {
  blocked: null,
  error: null,
  rendering: false,
  progress: 1,
  stale: false,
  problem: null,
  outdated: false,
  any: true,
};

test.each([
  [{}, "current", ""],
  [{ rendering: true, progress: 0.256 }, "rendering", "Rendering 25 %"],
  [{ outdated: true }, "outdated", "Stale"],
  [{ stale: true, rendering: true }, "stale", "Stale"],
  [{ stale: true, problem: "line 3: no" }, "stale", "Stale: line 3: no"],
  [{ error: "no memory", stale: true }, "error", "Error, last good picture: no memory"],
  [{ error: "no memory", any: false }, "error", "Error: no memory"],
  [{ any: false }, "empty", ""],
  [{ blocked: "Restricted Mode", error: "no memory" }, "blocked", ""],
] as [Partial<State>, string, string][])("%j", (state, kind, text) => {
  expect(badge({ ...CURRENT, ...state })).toMatchObject({ kind, text });
});

test("a pixel in words", () => {
  expect(pixelText({ x: 3, y: 14 }, [0.5, 1, 0], "mirage")).toBe("x 3  y 14   0.500  1.000  0.000   mirage");
  expect(pixelText({ x: 3, y: 14 }, null, "straight")).toContain("nothing yet");
});

test("what it shows in words", () => {
  const hit = { line: 61, position: [-1400.1234, 0, 2], depth: 1401.00004, path: { length: 1401.2, arcs: 14 } };
  expect(hitText(hit as Hit)).toBe("line 61   at -1400.12, 0, 2   depth 1401   path 1401.2 in 14 arcs");
  expect(hitText({ ...hit, path: { length: 5, arcs: 1 } } as Hit)).toMatch(/path 5$/);
  expect(hitText(null)).toBe("nothing is met here");
});
