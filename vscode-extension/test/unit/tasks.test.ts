/** Tasks become command lines of m3dc and m3d-render, and what those print becomes problems. */

import { expect, test } from "vitest";

import {
  compileArguments,
  pictureOf,
  renderArguments,
  successOf,
  type CompileTask,
  type RenderTask,
} from "../../src/arguments";
import manifest from "../../package.json" with { type: "json" };

test.each([
  [{}, "-o a.m3ir a.m3d"],
  [{ action: "check" }, "--check a.m3d"],
  [{ action: "dump" }, "--dump=a.dump a.m3d"],
  [{ action: "dump", output: "out/all.txt" }, "--dump=out/all.txt a.m3d"],
  [{ output: "out/a.m3ir", arguments: ["--deny", "all"] }, "-o out/a.m3ir --deny all a.m3d"],
] as [Partial<CompileTask>, string][])("m3dc %j", (task, expected) => {
  expect(compileArguments({ type: "m3dc", scene: "a.m3d", ...task }).join(" ")).toBe(expected);
});

test.each([
  [{}, "a.m3d -o a.png"],
  [{ scene: "a.m3ir", optics: "straight" }, "a.m3ir -o a-straight.png --straight"],
  [{ output: "a.exr", samples: 16, arguments: ["--width", "80"] }, "a.m3d -o a.exr --samples 16 --width 80"],
] as [Partial<RenderTask>, string][])("m3d-render %j", (task, expected) => {
  expect(renderArguments({ type: "m3d-render", scene: "a.m3d", ...task }).join(" ")).toBe(expected);
});

test.each([
  [{ type: "m3dc" }, "a.m3ir is written."],
  [{ type: "m3dc", action: "check" }, "a.m3d has no errors."],
  [{ type: "m3dc", action: "dump", output: "out/all.txt" }, "out/all.txt is written."],
  [{ type: "m3d-render", optics: "straight" }, "a-straight.png is written."],
])("a task that has ended well says so: %j", (task, expected) => {
  expect(successOf({ scene: "a.m3d", ...task } as CompileTask | RenderTask)).toBe(expected);
});

test("pictures of both kinds of light are files of their own", () => {
  expect([pictureOf("merman.m3d", "mirage"), pictureOf("merman.m3d", "straight")]).toEqual([
    "merman.png",
    "merman-straight.png",
  ]);
});

/** What the problem matcher finds in a line, by the names of its groups. */
function matched(line: string): Record<string, string | undefined> | null {
  const [pattern] = manifest.contributes.problemPatterns;
  const found = new RegExp(pattern?.regexp ?? "").exec(line);
  const groups = ["file", "line", "column", "severity", "code", "message"] as const;
  return found && Object.fromEntries(groups.map((group) => [group, found[pattern?.[group] ?? 0]]));
}

test("the problem matcher reads what m3dc prints", () => {
  expect(matched("first.m3d:12:28: error[M3D0106]: Invalid SUN statement")).toEqual({
    file: "first.m3d",
    line: "12",
    column: "28",
    severity: "error",
    code: "M3D0106",
    message: "Invalid SUN statement",
  });
  expect(matched("C:\\scenes\\a b.m3d:1:2: warning[M3D0201]: ASPECT must be 1 or more")).toMatchObject({
    file: "C:\\scenes\\a b.m3d",
    severity: "warning",
  });
  for (const line of ["      | ^^^^^", "first.m3d: 1 error", "   12 |     SKY { SUN { AZIMUTH 40 ZENIT 50 } }"]) {
    expect(matched(line)).toBeNull();
  }
});
