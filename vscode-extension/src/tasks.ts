/** The task types m3dc and m3d-render: for each scene that is open there are some to choose from. */

import * as path from "node:path";
import * as vscode from "vscode";

import { compileArguments, renderArguments, type CompileTask, type RenderTask } from "./arguments";
import { isScene } from "./scenes";
import { program } from "./surroundings";

/** The task made ready to run. */
export function taskOf(
  definition: CompileTask | RenderTask,
  scope: vscode.WorkspaceFolder | vscode.TaskScope,
  folder?: string,
): vscode.Task {
  const compiles = definition.type === "m3dc";
  const list = compiles ? compileArguments(definition) : renderArguments(definition);
  const name = compiles
    ? `${definition.action ?? "compile"} ${definition.scene}`
    : `render ${definition.scene}${definition.optics === "straight" ? " (straight)" : ""}`;
  const execution = new vscode.ProcessExecution(program(definition.type), list, folder ? { cwd: folder } : {});
  const task = new vscode.Task(definition, scope, name, definition.type, execution, "$m3dc");
  if (compiles) {
    task.group = vscode.TaskGroup.Build;
  }
  task.presentationOptions = { reveal: vscode.TaskRevealKind.Silent, clear: true, showReuseMessage: false };
  return task;
}

export function registerTasks(): vscode.Disposable {
  const provider = (definitions: (scene: string) => (CompileTask | RenderTask)[]): vscode.TaskProvider => ({
    provideTasks: () =>
      openScenes().flatMap(({ scene, folder }) =>
        definitions(scene).map((definition) => taskOf(definition, folder, folder.uri.fsPath)),
      ),
    resolveTask: (task) => {
      const definition = task.definition as CompileTask | RenderTask;
      const scope = task.scope ?? vscode.TaskScope.Workspace;
      return taskOf(definition, scope, typeof scope === "object" ? scope.uri.fsPath : undefined);
    },
  });
  return vscode.Disposable.from(
    vscode.tasks.registerTaskProvider(
      "m3dc",
      provider((scene) => (["check", "compile", "dump"] as const).map((action) => ({ type: "m3dc", scene, action }))),
    ),
    vscode.tasks.registerTaskProvider(
      "m3d-render",
      provider((scene) =>
        (["mirage", "straight"] as const).map((optics) => ({
          type: "m3d-render",
          scene,
          optics,
          ...(optics === "straight" && { output: `${scene.replace(/\.m3d$/, "")}-straight.png` }),
        })),
      ),
    ),
  );
}

/** The scenes that are open and lie in the workspace, by their paths within their folders. */
function openScenes(): { scene: string; folder: vscode.WorkspaceFolder }[] {
  return vscode.workspace.textDocuments.filter(isScene).flatMap(({ uri }) => {
    const folder = vscode.workspace.getWorkspaceFolder(uri);
    return folder === undefined ? [] : [{ scene: path.relative(folder.uri.fsPath, uri.fsPath), folder }];
  });
}
