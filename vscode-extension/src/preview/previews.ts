/** All previews: at most one that follows the editor, and any number that are pinned to their scenes. */

import * as path from "node:path";
import * as vscode from "vscode";

import type { Kept } from "../../webview/messages";
import { isScene, sceneOf, type Scenes } from "../scenes";
import type { Server } from "../server";
import { PreviewPanel, VIEW_TYPE } from "./panel";

export class Previews implements vscode.Disposable {
  private readonly panels = new Set<PreviewPanel>();
  private readonly registered: vscode.Disposable;

  constructor(
    private readonly server: Server,
    private readonly scenes: Scenes,
    private readonly extension: vscode.Uri,
  ) {
    this.registered = vscode.Disposable.from(
      scenes.onDidChangeActive((document) => this.following?.follow(document)),
      vscode.window.registerWebviewPanelSerializer(VIEW_TYPE, {
        deserializeWebviewPanel: (panel, state: unknown) => this.restore(panel, state),
      }),
      vscode.commands.registerCommand("m3d.preview", (uri?: unknown) => this.open(uri)),
      vscode.commands.registerCommand("m3d.preview.pin", () => this.active?.pin(!this.active.pinned)),
      vscode.commands.registerCommand("m3d.preview.save", () => this.active?.save()),
      vscode.commands.registerCommand("m3d.preview.saveScene", () => this.active?.saveScene()),
      vscode.commands.registerCommand("m3d.preview.again", () => this.active?.again()),
    );
  }

  dispose(): void {
    this.registered.dispose();
    for (const { panel } of this.panels) {
      panel.dispose();
    }
  }

  private get following(): PreviewPanel | undefined {
    return [...this.panels].find(({ pinned }) => !pinned);
  }

  private get active(): PreviewPanel | undefined {
    return [...this.panels].find(({ panel }) => panel.active) ?? this.following;
  }

  private async open(uri: unknown): Promise<void> {
    const document = await sceneOf(this.scenes, uri);
    if (document === undefined) {
      return;
    }
    const there = this.following ?? [...this.panels].find((panel) => panel.uri === document.uri.toString());
    if (there !== undefined) {
      there.follow(document);
      there.panel.reveal(undefined, true);
      return;
    }
    const panel = vscode.window.createWebviewPanel(
      VIEW_TYPE,
      `Preview ${path.basename(document.uri.path)}`,
      { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
      { enableScripts: true, retainContextWhenHidden: true },
    );
    this.add(panel, document);
  }

  private async restore(panel: vscode.WebviewPanel, state: unknown): Promise<void> {
    const { uri, pinned = false } = (state ?? {}) as Partial<Kept>;
    try {
      const document =
        uri === undefined ? this.scenes.active : await vscode.workspace.openTextDocument(vscode.Uri.parse(uri));
      if (isScene(document)) {
        this.add(panel, document).pin(pinned);
        return;
      }
    } catch {
      // The scene has gone; so does its preview.
    }
    panel.dispose();
  }

  private add(panel: vscode.WebviewPanel, document: vscode.TextDocument): PreviewPanel {
    const preview = new PreviewPanel(panel, document, this.server, this.scenes, this.extension);
    this.panels.add(preview);
    preview.onDidDispose(() => this.panels.delete(preview));
    // Unpinned, it follows: it is the only one that does.
    preview.onDidChangePinned(() => {
      for (const other of this.panels) {
        if (!preview.pinned && other !== preview && !other.pinned) {
          other.panel.dispose();
        }
      }
      if (!preview.pinned && this.scenes.active !== undefined) {
        preview.follow(this.scenes.active);
      }
    });
    return preview;
  }
}
