/** The task types m3dc and m3d-render: for each scene that is open there are some to choose from. */

import * as path from "node:path";
import * as vscode from "vscode";

import {
  compileArguments,
  outputOf,
  renderArguments,
  successOf,
  type CompileTask,
  type RenderTask,
} from "./arguments";
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
    vscode.tasks.onDidEndTaskProcess(({ execution: { task }, exitCode }) => {
      if (task.definition.type === "m3dc" || task.definition.type === "m3d-render") {
        void tell(task, exitCode);
      }
    }),
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
        })),
      ),
    ),
  );
}

/** Says how a task has ended: its terminal stays hidden. */
async function tell(ended: vscode.Task, status: number | undefined): Promise<void> {
  const task = ended.definition as CompileTask | RenderTask;
  const output = outputOf(task);
  if (status === undefined) {
    return; // It was stopped.
  }
  if (status !== 0) {
    const message = `${task.type} ended with status ${status} for ${task.scene}.`;
    if ((await vscode.window.showErrorMessage(message, "Show Problems")) !== undefined) {
      await vscode.commands.executeCommand("workbench.actions.view.problems");
    }
    return;
  }
  const isPicture = task.type === "m3d-render" && output !== null;
  const chosen = await vscode.window.showInformationMessage(successOf(task), ...(isPicture ? ["Open"] : []));
  if (chosen === "Open" && output !== null) {
    const { cwd } = (ended.execution as vscode.ProcessExecution | undefined)?.options ?? {};
    const folder = cwd ?? (typeof ended.scope === "object" ? ended.scope.uri.fsPath : "");
    await vscode.commands.executeCommand("vscode.open", vscode.Uri.file(path.resolve(folder, output)));
  }
}

/** The scenes that are open and lie in the workspace, by their paths within their folders. */
function openScenes(): { scene: string; folder: vscode.WorkspaceFolder }[] {
  return vscode.workspace.textDocuments.filter(isScene).flatMap(({ uri }) => {
    const folder = vscode.workspace.getWorkspaceFolder(uri);
    return folder === undefined ? [] : [{ scene: path.relative(folder.uri.fsPath, uri.fsPath), folder }];
  });
}
