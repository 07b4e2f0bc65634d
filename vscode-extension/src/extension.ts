/** Where VS Code comes in: what there is, put together. */

import * as vscode from "vscode";

import { registerCommands } from "./commands";
import { Previews } from "./preview/previews";
import * as protocol from "./protocol";
import { Scenes } from "./scenes";
import { Server } from "./server";
import { showStatus } from "./status";
import { registerTasks } from "./tasks";
import { DumpView } from "./views/dump";
import { TreeView } from "./views/tree";

let server: Server | undefined;

export function activate(context: vscode.ExtensionContext): void {
  const running = new Server();
  server = running;
  const scenes = new Scenes(running);
  context.subscriptions.push(
    running,
    scenes,
    showStatus(running, scenes),
    registerCommands(running, scenes, context.extensionUri),
    registerTasks(),
    new Previews(running, scenes, context.extensionUri),
    new DumpView(running, scenes),
    new TreeView("m3d.irTree", protocol.irTree, running, scenes),
    new TreeView("m3d.syntaxTree", protocol.syntaxTree, running, scenes),
    vscode.workspace.onDidGrantWorkspaceTrust(() => void running.restart()),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("m3d.server.path")) {
        void running.restart();
      }
    }),
  );
  // The server takes a moment to start; the editor need not wait for it.
  void running.restart();
}

export async function deactivate(): Promise<void> {
  await server?.stop();
}
