/** The tasks m3dc and m3d-render as they stand in tasks.json, and the command lines that they mean. */

export interface CompileTask {
  type: "m3dc";
  scene: string;
  action?: "check" | "compile" | "dump";
  output?: string;
  arguments?: string[];
}

export interface RenderTask {
  type: "m3d-render";
  scene: string;
  output?: string;
  optics?: "mirage" | "straight";
  samples?: number;
  arguments?: string[];
}

/** The arguments of m3dc. */
export function compileArguments(task: CompileTask): string[] {
  const { scene, action = "compile", output, arguments: more = [] } = task;
  const beside = (suffix: string): string => output ?? scene.replace(/\.m3d$/, "") + suffix;
  const what = {
    check: ["--check"],
    compile: ["-o", beside(".m3ir")],
    dump: [`--dump=${beside(".dump")}`],
  }[action];
  return [...what, ...more, scene];
}

/** The arguments of m3d-render. */
export function renderArguments(task: RenderTask): string[] {
  const { scene, output, optics = "mirage", samples, arguments: more = [] } = task;
  const target = output ?? `${scene.replace(/\.(m3d|m3ir)$/, "")}.png`;
  return [
    scene,
    "-o",
    target,
    ...(optics === "straight" ? ["--straight"] : []),
    ...(samples === undefined ? [] : ["--samples", String(samples)]),
    ...more,
  ];
}
