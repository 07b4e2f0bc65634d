/**
 * Two trees of a scene: the tables that it compiles to, and how its text was read.
 *
 * A tree shows the scene being edited and follows its cursor; a chosen node is shown in the text. Nothing is asked
 * while nobody sees it.
 */

import * as vscode from "vscode";
import type { RequestType, TextDocumentIdentifier } from "vscode-languageclient/node";

import { narrowest } from "../places";
import * as protocol from "../protocol";
import type { Scenes } from "../scenes";
import type { Server } from "../server";

type Question = RequestType<{ textDocument: TextDocumentIdentifier }, protocol.Tree | null, void>;

interface Branch {
  node: protocol.Node;
  parent: Branch | undefined;
  children: Branch[];
}

export class TreeView implements vscode.Disposable, vscode.TreeDataProvider<Branch> {
  private readonly changed = new vscode.EventEmitter<void>();
  readonly onDidChangeTreeData = this.changed.event;
  private readonly view: vscode.TreeView<Branch>;
  private readonly registered: vscode.Disposable;
  private roots: Branch[] = [];
  /** Every branch that has a place in the text. */
  private placed: Branch[] = [];
  /** The version whose places the tree has. */
  private version = 0;
  private scene: vscode.Uri | undefined;
  private asked = 0;

  constructor(
    id: "m3d.irTree" | "m3d.syntaxTree",
    private readonly question: Question,
    private readonly server: Server,
    private readonly scenes: Scenes,
  ) {
    this.view = vscode.window.createTreeView(id, { treeDataProvider: this, showCollapseAll: true });
    this.registered = vscode.Disposable.from(
      this.view,
      this.view.onDidChangeVisibility(() => void this.ask()),
      scenes.onDidChangeActive(() => void this.ask()),
      server.onDidChangeState(() => void this.ask()),
      server.onDidAnalyse(({ uri }) => {
        if (vscode.Uri.parse(uri).toString() === scenes.active?.uri.toString()) {
          void this.ask();
        }
      }),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => void this.follow(textEditor)),
    );
  }

  dispose(): void {
    this.registered.dispose();
    this.changed.dispose();
  }

  getChildren(branch?: Branch): Branch[] {
    return branch?.children ?? this.roots;
  }

  getParent(branch: Branch): Branch | undefined {
    return branch.parent;
  }

  getTreeItem({ node, children }: Branch): vscode.TreeItem {
    const closed = children.length === 0 ? "None" : "Collapsed";
    const item = new vscode.TreeItem(node.label, vscode.TreeItemCollapsibleState[closed]);
    if (node.description) {
      item.description = node.description;
      item.tooltip = `${node.label} ${node.description}`;
    }
    if (node.range && this.scene) {
      const { scene, version } = this;
      item.command = { command: "m3d.reveal", title: "Show in the Scene", arguments: [scene, version, node.range] };
    }
    return item;
  }

  private async ask(): Promise<void> {
    const document = this.scenes.active;
    if (this.server.state.kind !== "running") {
      this.asked++;
      this.clear();
      return;
    }
    if (!this.view.visible || document === undefined) {
      return;
    }
    const asked = ++this.asked;
    let tree: protocol.Tree | null = null;
    try {
      tree = await this.server.request(this.question, { textDocument: { uri: document.uri.toString() } });
    } catch (fault) {
      this.view.message = fault instanceof Error ? fault.message : String(fault);
    }
    if (asked !== this.asked || tree === null) {
      return;
    }
    this.scene = document.uri;
    this.version = this.scenes.versionOf(document.uri);
    this.placed = [];
    this.roots = tree.nodes.map((node) => this.branch(node, undefined));
    this.view.message = tree.stale ? "The scene has errors: this is its last version without any." : "";
    this.changed.fire();
    await this.follow(vscode.window.activeTextEditor);
  }

  /** Without a tree the view says why: package.json has the words. */
  private clear(): void {
    this.roots = this.placed = [];
    this.view.message = "";
    this.changed.fire();
  }

  private branch(node: protocol.Node, parent: Branch | undefined): Branch {
    const branch: Branch = { node, parent, children: [] };
    if (node.range) {
      this.placed.push(branch);
    }
    branch.children = (node.children ?? []).map((child) => this.branch(child, branch));
    return branch;
  }

  /** Chooses what the cursor is in. */
  private async follow(editor: vscode.TextEditor | undefined): Promise<void> {
    if (!this.view.visible || editor === undefined || editor.document.uri.toString() !== this.scene?.toString()) {
      return;
    }
    const place = this.scenes.editsOf(editor.document.uri).toThen(this.version, editor.selection.active);
    const found = this.placed[narrowest(this.placed.map(({ node }) => node.range), place)];
    try {
      if (found !== undefined) {
        await this.view.reveal(found, { select: true, focus: false });
      }
    } catch {
      // The tree has been replaced meanwhile.
    }
  }
}
