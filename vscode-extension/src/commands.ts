/** The commands that are neither a view's nor a preview's. */

import * as path from "node:path";
import * as vscode from "vscode";
import type { Location, Position, Range } from "vscode-languageclient/node";

import { savePicture, tellRestricted } from "./preview/save";
import { reveal } from "./reveal";
import { sceneOf, type Scenes } from "./scenes";
import type { Server } from "./server";
import { previewSettings } from "./settings";
import { taskOf } from "./tasks";

export function registerCommands(server: Server, scenes: Scenes, extension: vscode.Uri): vscode.Disposable {
  const command = vscode.commands.registerCommand;
  return vscode.Disposable.from(
    command("m3d.restartServer", () => server.restart()),
    command("m3d.showOutput", () => server.output.show()),
    command("m3d.chooseServer", chooseServer),
    command("m3d.newScene", () => newScene(extension)),
    command("m3d.compile", async (uri?: unknown) => compile(await sceneOf(scenes, uri))),
    command("m3d.render", async (uri?: unknown) => render(server, await sceneOf(scenes, uri))),
    command("m3d.format", async (uri?: unknown) => format(await sceneOf(scenes, uri))),
    command("m3d.reveal", (uri: vscode.Uri, version: number, range: Range) =>
      reveal(uri, scenes.rangeNow(uri, version, range)),
    ),
    command("m3d.showReferences", (uri: string, position: Position, locations: Location[]) =>
      vscode.commands.executeCommand(
        "editor.action.showReferences",
        vscode.Uri.parse(uri),
        new vscode.Position(position.line, position.character),
        locations.map((location) => new vscode.Location(vscode.Uri.parse(location.uri), rangeOf(location.range))),
      ),
    ),
  );
}

function rangeOf({ start, end }: Range): vscode.Range {
  return new vscode.Range(start.line, start.character, end.line, end.character);
}

/** A scene to begin with: that of the walkthrough. */
async function newScene(extension: vscode.Uri): Promise<void> {
  const bytes = await vscode.workspace.fs.readFile(vscode.Uri.joinPath(extension, "walkthrough", "mirage.m3d"));
  const content = new TextDecoder().decode(bytes);
  await vscode.window.showTextDocument(await vscode.workspace.openTextDocument({ language: "m3d", content }));
}

async function chooseServer(): Promise<void> {
  const chosen = await vscode.window.showOpenDialog({ title: "The program m3d-lsp", openLabel: "Use This Program" });
  const file = chosen?.[0];
  if (file !== undefined) {
    const settings = vscode.workspace.getConfiguration("m3d");
    // The extension starts the server anew when this setting changes.
    const before = settings.get<string>("server.path");
    await settings.update("server.path", file.fsPath, vscode.ConfigurationTarget.Global);
    if (before === file.fsPath) {
      await vscode.commands.executeCommand("m3d.restartServer");
    }
  }
}

async function compile(document: vscode.TextDocument | undefined): Promise<void> {
  if (document === undefined) {
    return;
  }
  if (!vscode.workspace.isTrusted) {
    await tellRestricted();
    return;
  }
  // m3dc reads the file.
  if (!(await document.save())) {
    void vscode.window.showWarningMessage("Save the scene first: m3dc compiles the file.");
    return;
  }
  const folder = vscode.workspace.getWorkspaceFolder(document.uri);
  const place = folder?.uri.fsPath ?? path.dirname(document.uri.fsPath);
  const scene = path.relative(place, document.uri.fsPath);
  await vscode.tasks.executeTask(
    taskOf({ type: "m3dc", scene, action: "compile" }, folder ?? vscode.TaskScope.Workspace, place),
  );
}

async function render(server: Server, document: vscode.TextDocument | undefined): Promise<void> {
  if (document === undefined) {
    return;
  }
  const { show, render } = previewSettings(document.uri).options;
  await savePicture(server, document, show === "straight" ? "straight" : "mirage", render);
}

async function format(document: vscode.TextDocument | undefined): Promise<void> {
  if (document !== undefined) {
    await vscode.window.showTextDocument(document);
    await vscode.commands.executeCommand("editor.action.formatDocument");
  }
}
