/** Writes a scene's picture, whole and at its own size, into a file that a person chooses. */

import * as path from "node:path";
import * as vscode from "vscode";

import type { Optics } from "mirage3d-picture/host";
import { PICTURE_FORMATS } from "mirage3d-picture/protocol";
import { pictureOf } from "../arguments";
import * as protocol from "../protocol";
import type { Server } from "../server";

export async function savePicture(
  server: Server,
  document: vscode.TextDocument,
  optics: Optics,
  options: protocol.RenderOptions,
): Promise<void> {
  if (!vscode.workspace.isTrusted) {
    await tellRestricted();
    return;
  }
  const target = await vscode.window.showSaveDialog({
    title: `Save the picture of ${path.basename(document.uri.path)} (${optics})`,
    defaultUri: beside(document.uri, optics),
    filters: PICTURE_FORMATS,
  });
  if (target === undefined) {
    return;
  }
  const params = { textDocument: { uri: document.uri.toString() }, optics, path: target.fsPath, ...options };
  const name = path.basename(target.fsPath);
  const saved = await vscode.window.withProgress(
    { location: vscode.ProgressLocation.Notification, title: `Rendering ${name}`, cancellable: true },
    (_, token) =>
      server.request(protocol.save, params, token).catch((fault: unknown): protocol.Saved => {
        const message = fault instanceof Error ? fault.message : String(fault);
        return { status: token.isCancellationRequested ? "cancelled" : "error", path: target.fsPath, message };
      }),
  );
  if (saved.status === "error") {
    void vscode.window.showErrorMessage(`${name} was not written: ${saved.message ?? "the server gave no reason"}`);
  } else if (saved.status === "done") {
    const chosen = await vscode.window.showInformationMessage(`${name} is written.`, "Open");
    if (chosen === "Open") {
      await vscode.commands.executeCommand("vscode.open", target);
    }
  }
}

export async function tellRestricted(): Promise<void> {
  const manage = "Manage Workspace Trust";
  const message = "Nothing is rendered or run in Restricted Mode.";
  if ((await vscode.window.showWarningMessage(message, manage)) === manage) {
    await vscode.commands.executeCommand("workbench.trust.manage");
  }
}

/** scene.png beside scene.m3d, or scene-straight.png; an unsaved scene's goes into the workspace's folder. */
function beside(scene: vscode.Uri, optics: Optics): vscode.Uri {
  const name = pictureOf(path.basename(scene.path), optics);
  if (scene.scheme === "file") {
    return vscode.Uri.joinPath(scene, "..", name);
  }
  return vscode.Uri.joinPath(vscode.workspace.workspaceFolders?.[0]?.uri ?? vscode.Uri.file("/"), name);
}
