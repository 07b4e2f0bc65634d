/** The item in the status bar, and the message when the language server is missing or keeps failing. */

import * as vscode from "vscode";

import { commandOf, type Action } from "./actions";
import { HOW_TO_INSTALL, look } from "./look";
import { isScene, type Scenes } from "./scenes";
import type { Server, ServerState } from "./server";

export function showStatus(server: Server, scenes: Scenes): vscode.Disposable {
  const item = vscode.window.createStatusBarItem("m3d.status", vscode.StatusBarAlignment.Right, 90);
  item.name = "Mirage3D";
  item.command = "m3d.status";
  const update = (): void => {
    const { text, tooltip, label, color } = look(server.state, vscode.workspace.isTrusted);
    item.text = text;
    item.tooltip = tooltip;
    item.accessibilityInformation = { label, role: "button" };
    item.backgroundColor = color === undefined ? undefined : new vscode.ThemeColor(color);
    // Without an editor the keyboard may be in a preview.
    const document = vscode.window.activeTextEditor?.document ?? scenes.active;
    if (isScene(document)) {
      item.show();
    } else {
      item.hide();
    }
  };
  let told = false;
  const tell = (state: ServerState): void => {
    update();
    if (state.kind === "running") {
      told = false;
    } else if (!told && (state.kind === "missing" || state.kind === "failed")) {
      told = true;
      void (state.kind === "missing" ? tellMissing() : tellFailed(state.reason));
    }
  };
  update();
  return vscode.Disposable.from(
    item,
    server.onDidChangeState(tell),
    vscode.window.onDidChangeActiveTextEditor(update),
    vscode.workspace.onDidGrantWorkspaceTrust(update),
    vscode.commands.registerCommand("m3d.status", () => chooseAction(server)),
  );
}

async function tellMissing(): Promise<void> {
  const restricted = vscode.workspace.isTrusted ? "" : " In Restricted Mode the workspace's .venv is not looked at.";
  const chosen = await vscode.window.showWarningMessage(
    `The Mirage3D language server, m3d-lsp, was not found: there are colours and snippets, but no checking and no ` +
      `pictures.${restricted} ${HOW_TO_INSTALL}`,
    ...offered("Choose Program...", "Try Again", "Show Output"),
  );
  await carryOut(chosen);
}

async function tellFailed(reason: string): Promise<void> {
  const chosen = await vscode.window.showErrorMessage(
    `Mirage3D: ${reason}`,
    ...offered("Try Again", "Choose Program...", "Show Output"),
  );
  await carryOut(chosen);
}

async function chooseAction(server: Server): Promise<void> {
  const { tooltip } = look(server.state, vscode.workspace.isTrusted);
  const actions = offered("Open Preview", "Show Output", "Restart Language Server", "Choose Program...");
  await carryOut(await vscode.window.showQuickPick(actions, { title: "Mirage3D", placeHolder: tooltip }));
}

function offered(...actions: Action[]): Action[] {
  return actions;
}

export async function carryOut(action: string | undefined): Promise<void> {
  const command = commandOf(action);
  if (command !== undefined) {
    await vscode.commands.executeCommand(command);
  }
}
