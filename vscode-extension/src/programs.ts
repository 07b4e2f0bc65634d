/**
 * Finding the programs of the project: m3d-lsp, and m3dc and m3d-render beside it.
 *
 * Where one looks, in this order: the setting, the workspace's `.venv` (if the workspace is trusted: its programs would
 * run), the path.
 */

import * as path from "node:path";

export interface Surroundings {
  /** The setting m3d.server.path; may be empty. */
  setting: string;
  /** The folders of the workspace. */
  folders: readonly string[];
  trusted: boolean;
  /** The environment's PATH. */
  path: string;
  home: string;
  windows: boolean;
  /** Whether there is a file that can be run. */
  runnable(file: string): boolean;
}

export interface Found {
  program: string;
  /** For people. */
  where: "setting" | "workspace" | "path";
}

export interface Missing {
  /** Where one has looked, for people. */
  looked: string[];
}

export function findServer(around: Surroundings): Found | Missing {
  const looked: string[] = [];
  if (around.setting !== "") {
    const program = resolved(around.setting, around);
    // What was asked for by name is not silently replaced by another.
    return around.runnable(program)
      ? { program, where: "setting" }
      : { looked: [`${program} (the setting m3d.server.path)`] };
  }
  for (const folder of around.trusted ? around.folders : []) {
    const program = path.join(folder, ".venv", around.windows ? "Scripts" : "bin", executable("m3d-lsp", around));
    if (around.runnable(program)) {
      return { program, where: "workspace" };
    }
    looked.push(program);
  }
  for (const folder of searchPath(around)) {
    const program = path.join(folder, executable("m3d-lsp", around));
    if (around.runnable(program)) {
      return { program, where: "path" };
    }
  }
  return { looked: [...looked, "the folders of PATH"] };
}

/** Another program of the project: beside the server, else on the path; the bare name if it is in neither. */
export function findProgram(name: string, server: Found | Missing, around: Surroundings): string {
  const beside = "program" in server ? [path.dirname(server.program)] : [];
  const folders = [...beside, ...searchPath(around)];
  const files = folders.map((folder) => path.join(folder, executable(name, around)));
  return files.find((file) => around.runnable(file)) ?? name;
}

function executable(name: string, { windows }: Surroundings): string {
  return windows ? `${name}.exe` : name;
}

function searchPath(around: Surroundings): string[] {
  return around.path.split(around.windows ? ";" : ":").filter((folder) => path.isAbsolute(folder));
}

/** An absolute path: `~` is the home folder, `${workspaceFolder}` and what is relative mean the first folder. */
function resolved(setting: string, { home, folders }: Surroundings): string {
  const first = folders[0] ?? home;
  const filled = setting.replace("${workspaceFolder}", first).replace(/^~(?=$|[\\/])/, home);
  return path.resolve(first, filled);
}
