/**
 * The dump of a scene as a document beside it, read-only: everything that the scene resolves to.
 *
 * The cursor is followed both ways. While the scene has errors, the dump is that of its last version without, and says
 * so in its first line.
 */

import * as path from "node:path";
import * as vscode from "vscode";

import type { Span } from "../edits";
import { narrowest, same } from "../places";
import * as protocol from "../protocol";
import { isScene, sceneOf, type Scenes } from "../scenes";
import type { Server } from "../server";

const SCHEME = "m3d-dump";
const STALE = "*** The scene has errors: this is what its last version without any resolves to. ***";

interface Shown {
  /** The version whose places the ranges are. */
  version: number;
  /** For each line of the document what it tells of. */
  ranges: (Span | null)[];
}

export class DumpView implements vscode.Disposable, vscode.TextDocumentContentProvider {
  private readonly changed = new vscode.EventEmitter<vscode.Uri>();
  readonly onDidChange = this.changed.event;
  private readonly shown = new Map<string, Shown>();
  private readonly belongs = vscode.window.createTextEditorDecorationType({
    isWholeLine: true,
    backgroundColor: new vscode.ThemeColor("editor.rangeHighlightBackground"),
    borderColor: new vscode.ThemeColor("editor.rangeHighlightBorder"),
    overviewRulerColor: new vscode.ThemeColor("editorOverviewRuler.rangeHighlightForeground"),
  });
  private readonly registered: vscode.Disposable;

  constructor(
    private readonly server: Server,
    private readonly scenes: Scenes,
  ) {
    this.registered = vscode.Disposable.from(
      this.belongs,
      vscode.workspace.registerTextDocumentContentProvider(SCHEME, this),
      vscode.commands.registerCommand("m3d.dump", (uri?: unknown, position?: protocol.Mask["range"]["start"]) =>
        this.open(uri, position),
      ),
      server.onDidAnalyse(({ uri }) => this.refresh(dumpOf(vscode.Uri.parse(uri)))),
      server.onDidChangeState(() => this.refreshAll()),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => {
        if (textEditor === vscode.window.activeTextEditor) {
          this.follow(textEditor);
        }
      }),
    );
  }

  dispose(): void {
    this.registered.dispose();
    this.changed.dispose();
  }

  async provideTextDocumentContent(uri: vscode.Uri, token: vscode.CancellationToken): Promise<string> {
    const scene = sceneOfDump(uri);
    let dump: protocol.Dump | null;
    try {
      dump = await this.server.request(protocol.dump, { textDocument: { uri: scene.toString() } }, token);
    } catch (fault) {
      this.shown.delete(uri.toString());
      return `There is no dump: ${fault instanceof Error ? fault.message : String(fault)}.\n`;
    }
    if (dump === null) {
      this.shown.delete(uri.toString());
      return "There is no dump: the scene has had errors since it was opened.\n";
    }
    const { stale, text, ranges } = dump;
    const version = this.scenes.versionOf(scene);
    this.shown.set(uri.toString(), { version, ranges: stale ? [null, ...ranges] : ranges });
    return stale ? `${STALE}\n${text}` : text;
  }

  private async open(uri: unknown, position?: protocol.Mask["range"]["start"]): Promise<void> {
    const document = await sceneOf(this.scenes, uri);
    if (document === undefined) {
      return;
    }
    const dump = await vscode.workspace.openTextDocument(dumpOf(document.uri));
    await vscode.window.showTextDocument(dump, {
      viewColumn: vscode.ViewColumn.Beside,
      preserveFocus: true,
      preview: true,
    });
    const editor = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
    const at = position ?? editor?.selection.active;
    if (at !== undefined) {
      this.showInDump(document.uri, at);
    }
  }

  private refresh(dump: vscode.Uri): void {
    if (vscode.workspace.textDocuments.some((document) => document.uri.toString() === dump.toString())) {
      this.changed.fire(dump);
    }
  }

  private refreshAll(): void {
    for (const { uri } of vscode.workspace.textDocuments) {
      if (uri.scheme === SCHEME) {
        this.changed.fire(uri);
      }
    }
  }

  private follow(editor: vscode.TextEditor): void {
    const { document, selection } = editor;
    if (document.uri.scheme === SCHEME) {
      this.showInScene(document.uri, selection.active.line);
    } else if (isScene(document)) {
      this.showInDump(document.uri, selection.active);
    }
  }

  /** Marks the lines of the dump that tell of what is at a place of the scene. */
  private showInDump(scene: vscode.Uri, at: { line: number; character: number }): void {
    const dump = dumpOf(scene);
    const editor = editorOf(dump);
    const shown = this.shown.get(dump.toString());
    if (editor === undefined || shown === undefined) {
      return;
    }
    const place = this.scenes.editsOf(scene).toThen(shown.version, at);
    const found = shown.ranges[narrowest(shown.ranges, place)];
    const lines = found ? [...shown.ranges.keys()].filter((line) => same(shown.ranges[line], found)) : [];
    this.mark(editor, lines.map((line) => new vscode.Range(line, 0, line, 0)));
  }

  /** Marks what a line of the dump tells of. */
  private showInScene(dump: vscode.Uri, line: number): void {
    const scene = sceneOfDump(dump);
    const editor = editorOf(scene);
    const shown = this.shown.get(dump.toString());
    const range = shown?.ranges[line];
    if (editor !== undefined && shown !== undefined) {
      this.mark(editor, range ? [this.scenes.rangeNow(scene, shown.version, range)] : []);
    }
  }

  private mark(editor: vscode.TextEditor, ranges: vscode.Range[]): void {
    editor.setDecorations(this.belongs, ranges);
    if (ranges[0] !== undefined) {
      editor.revealRange(ranges[0], vscode.TextEditorRevealType.InCenterIfOutsideViewport);
    }
  }
}

/** m3d-dump:/scene.m3d.dump?file:///folder/scene.m3d */
function dumpOf(scene: vscode.Uri): vscode.Uri {
  const name = `/${path.basename(scene.path)}.dump`;
  return vscode.Uri.from({ scheme: SCHEME, path: name, query: scene.toString() });
}

function sceneOfDump(dump: vscode.Uri): vscode.Uri {
  return vscode.Uri.parse(dump.query);
}

function editorOf(uri: vscode.Uri): vscode.TextEditor | undefined {
  return vscode.window.visibleTextEditors.find((editor) => editor.document.uri.toString() === uri.toString());
}
