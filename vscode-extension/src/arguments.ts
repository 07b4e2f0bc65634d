/** The tasks m3dc and m3d-render as they stand in tasks.json, and the command lines that they mean. */

import { RENDER_OPTION_NAMES, type RenderOptions } from "mirage3d-picture/protocol";

export interface CompileTask {
  type: "m3dc";
  scene: string;
  action?: "check" | "compile" | "dump";
  output?: string;
  arguments?: string[];
}

export interface RenderTask extends RenderOptions {
  type: "m3d-render";
  scene: string;
  output?: string;
  optics?: "mirage" | "straight";
  arguments?: string[];
}

const SUFFIXES = { check: null, compile: ".m3ir", dump: ".dump" };

/** The picture's file of a scene, beside it: those of both kinds of light have names of their own. */
export function pictureOf(scene: string, optics: "mirage" | "straight"): string {
  return `${scene.replace(/\.(m3d|m3ir)$/, "")}${optics === "straight" ? "-straight" : ""}.png`;
}

/** The file that a task writes; null: none. */
export function outputOf(task: CompileTask | RenderTask): string | null {
  if (task.type === "m3d-render") {
    return task.output ?? pictureOf(task.scene, task.optics ?? "mirage");
  }
  const suffix = SUFFIXES[task.action ?? "compile"];
  return suffix === null ? null : (task.output ?? task.scene.replace(/\.m3d$/, "") + suffix);
}

/** What is said when a task has ended well. */
export function successOf(task: CompileTask | RenderTask): string {
  const output = outputOf(task);
  return output === null ? `${task.scene} has no errors.` : `${output} is written.`;
}

/** The arguments of m3dc. */
export function compileArguments(task: CompileTask): string[] {
  const { scene, action = "compile", arguments: more = [] } = task;
  const output = outputOf(task) ?? "";
  const what = { check: ["--check"], compile: ["-o", output], dump: [`--dump=${output}`] }[action];
  return [...what, ...more, scene];
}

/** The arguments of m3d-render. */
export function renderArguments(task: RenderTask): string[] {
  const { scene, optics = "mirage", arguments: more = [] } = task;
  return [
    scene,
    "-o",
    outputOf(task) ?? "",
    ...(optics === "straight" ? ["--straight"] : []),
    ...RENDER_OPTION_NAMES.flatMap((name) => option(name, task[name])),
    ...more,
  ];
}

/** A render option as m3d-render takes it. */
function option(name: string, value: number | boolean | undefined): string[] {
  const flag = `--${name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}`;
  return value === undefined || value === false ? [] : value === true ? [flag] : [flag, String(value)];
}
