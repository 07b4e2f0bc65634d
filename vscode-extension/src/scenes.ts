/** The scenes that are open: which one is being edited, and where places of their older versions are now. */

import * as vscode from "vscode";

import { Edits, type Span } from "./edits";
import type { Analysed } from "./protocol";
import type { Server } from "./server";

export function isScene(document: vscode.TextDocument | undefined): document is vscode.TextDocument {
  return document?.languageId === "m3d";
}

export class Scenes implements vscode.Disposable {
  private readonly activeChanged = new vscode.EventEmitter<vscode.TextDocument>();
  /** Another scene is being edited. */
  readonly onDidChangeActive = this.activeChanged.event;

  private last: vscode.TextDocument | undefined;
  private readonly edits = new Map<string, Edits>();
  private readonly states = new Map<string, Analysed>();
  private readonly listening: vscode.Disposable;

  constructor(server: Server) {
    this.last = [vscode.window.activeTextEditor, ...vscode.window.visibleTextEditors]
      .map((editor) => editor?.document)
      .find(isScene);
    this.listening = vscode.Disposable.from(
      vscode.window.onDidChangeActiveTextEditor((editor) => this.activate(editor?.document)),
      vscode.workspace.onDidOpenTextDocument((document) => {
        // A file may become a scene after it was opened.
        if (document === vscode.window.activeTextEditor?.document) {
          this.activate(document);
        }
      }),
      vscode.workspace.onDidChangeTextDocument(({ document, contentChanges }) => {
        if (isScene(document) && contentChanges.length > 0) {
          this.editsOf(document.uri).add(document.version, contentChanges);
        }
      }),
      vscode.workspace.onDidCloseTextDocument(({ uri }) => {
        this.edits.delete(uri.toString());
        this.states.delete(uri.toString());
        if (this.last?.uri.toString() === uri.toString()) {
          this.last = undefined;
        }
      }),
      server.onDidAnalyse((analysed) => this.states.set(vscode.Uri.parse(analysed.uri).toString(), analysed)),
    );
  }

  /** The scene in the active editor, or the last that was in one. */
  get active(): vscode.TextDocument | undefined {
    return this.last;
  }

  editsOf(uri: vscode.Uri): Edits {
    const key = uri.toString();
    const edits = this.edits.get(key) ?? new Edits();
    this.edits.set(key, edits);
    return edits;
  }

  /** What the server last told of a scene. */
  stateOf(uri: vscode.Uri): Analysed | undefined {
    return this.states.get(uri.toString());
  }

  /** The version that a scene's text has now: that of the places in an answer that comes now. */
  versionOf(uri: vscode.Uri): number {
    const key = uri.toString();
    return vscode.workspace.textDocuments.find((document) => document.uri.toString() === key)?.version ?? 0;
  }

  /** The range of now for one of an older version. */
  rangeNow(uri: vscode.Uri, version: number, range: Span): vscode.Range {
    const edits = this.editsOf(uri);
    const start = edits.toNow(version, range.start);
    const end = edits.toNow(version, range.end);
    return new vscode.Range(start.line, start.character, end.line, end.character);
  }

  dispose(): void {
    this.listening.dispose();
    this.activeChanged.dispose();
  }

  private activate(document: vscode.TextDocument | undefined): void {
    if (isScene(document) && document !== this.last) {
      this.last = document;
      this.activeChanged.fire(document);
    }
  }
}

/** The scene that a command was called for: the one it names, or the one being edited. */
export async function sceneOf(scenes: Scenes, uri: unknown): Promise<vscode.TextDocument | undefined> {
  if (uri instanceof vscode.Uri) {
    return vscode.workspace.openTextDocument(uri);
  }
  if (typeof uri === "string") {
    return vscode.workspace.openTextDocument(vscode.Uri.parse(uri));
  }
  if (scenes.active === undefined) {
    void vscode.window.showInformationMessage("Open a scene first: a file that ends in .m3d.");
  }
  return scenes.active;
}
