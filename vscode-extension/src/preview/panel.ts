/** One preview: a panel with the page of the picture part, whose questions the language server answers. */

import * as path from "node:path";
import * as vscode from "vscode";

import type { Hit, Mask, Optics, Rendered, Scene } from "mirage3d-picture/host";
import type { FromPage, ToPage } from "../../webview/messages";
import { obstacle } from "../actions";
import * as protocol from "../protocol";
import { reveal } from "../reveal";
import type { Scenes } from "../scenes";
import type { Server } from "../server";
import { carryOut } from "../status";
import { previewSettings } from "../settings";
import { page } from "./page";
import { savePicture } from "./save";

export const VIEW_TYPE = "m3d.preview";

let panels = 0;

export class PreviewPanel {
  private readonly name = `panel-${++panels}`;
  private readonly listening: vscode.Disposable;
  private readonly disposed = new vscode.EventEmitter<void>();
  private readonly pinnedChanged = new vscode.EventEmitter<void>();
  readonly onDidDispose = this.disposed.event;
  readonly onDidChangePinned = this.pinnedChanged.event;
  private isReady = false;
  private isPinned = false;
  private toldProblem: string | undefined;

  constructor(
    readonly panel: vscode.WebviewPanel,
    private document: vscode.TextDocument,
    private readonly server: Server,
    private readonly scenes: Scenes,
    extension: vscode.Uri,
  ) {
    const icon = (theme: string): vscode.Uri => vscode.Uri.joinPath(extension, "icons", `m3d-${theme}.svg`);
    panel.iconPath = { light: icon("light"), dark: icon("dark") };
    panel.webview.options = { enableScripts: true, localResourceRoots: [vscode.Uri.joinPath(extension, "dist")] };
    this.listening = vscode.Disposable.from(
      panel.webview.onDidReceiveMessage((message: FromPage) => void this.take(message)),
      panel.onDidChangeViewState(() => this.say({ type: "visible", visible: panel.visible })),
      server.onTile((tile) => this.passOn(tile)),
      server.onDidAnalyse(({ uri }) => {
        if (vscode.Uri.parse(uri).toString() === this.uri) {
          this.sayScene(this.settings.renderOn === "type");
        }
      }),
      server.onDidChangeState(() => this.sayBlocked()),
      vscode.workspace.onDidGrantWorkspaceTrust(() => this.sayBlocked()),
      vscode.workspace.onDidChangeTextDocument((event) => {
        if (event.document === this.document && event.contentChanges.length > 0) {
          this.sayScene(false);
        }
      }),
      vscode.workspace.onDidSaveTextDocument((document) => {
        if (document === this.document && this.settings.renderOn === "save") {
          this.sayScene(true);
        }
      }),
      vscode.languages.onDidChangeDiagnostics(({ uris }) => {
        if (uris.some((uri) => uri.toString() === this.uri) && this.problem()?.message !== this.toldProblem) {
          this.sayScene(false);
        }
      }),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => {
        if (textEditor.document === this.document) {
          this.say({ type: "cursor" });
        }
      }),
      vscode.workspace.onDidChangeConfiguration((event) => {
        if (event.affectsConfiguration("m3d.preview", this.document.uri)) {
          this.say({ type: "options", options: this.settings.options });
          this.say({ type: "cursor" });
        }
      }),
      panel.onDidDispose(() => this.dispose()),
    );
    this.title();
    panel.webview.html = page(panel.webview, extension);
  }

  get pinned(): boolean {
    return this.isPinned;
  }

  get uri(): string {
    return this.document.uri.toString();
  }

  /** Shows another scene. */
  follow(document: vscode.TextDocument): void {
    if (document.uri.toString() !== this.uri) {
      this.document = document;
      this.title();
      this.sayScene(true);
    }
  }

  pin(pinned: boolean): void {
    this.isPinned = pinned;
    this.title();
    this.say({ type: "options", options: { pinned } });
    this.pinnedChanged.fire();
  }

  again(): void {
    this.say({ type: "again" });
  }

  save(): void {
    this.say({ type: "save" });
  }

  async saveScene(): Promise<void> {
    await this.document.save();
  }

  private get settings(): ReturnType<typeof previewSettings> {
    return previewSettings(this.document.uri);
  }

  private id(optics: Optics): string {
    return `${this.name}/${optics}`;
  }

  // --- to the page ---------------------------------------------------------------------------------------------

  private say(message: ToPage): void {
    if (this.isReady) {
      void this.panel.webview.postMessage(message);
    }
  }

  private sayScene(render: boolean): void {
    const { uri, version } = this.document;
    const state = this.scenes.stateOf(uri);
    const errors = state?.ok === false && state.version === version;
    const first = errors ? this.problem() : undefined;
    this.toldProblem = first?.message;
    const problem = first === undefined ? null : `line ${first.range.start.line + 1}: ${first.message}`;
    const scene: Scene = { id: uri.toString(), name: path.basename(uri.path), version, render, errors, problem };
    this.say({ type: "scene", scene });
  }

  /** The first error of the text. */
  private problem(): vscode.Diagnostic | undefined {
    const errors = vscode.languages
      .getDiagnostics(this.document.uri)
      .filter(({ severity }) => severity === vscode.DiagnosticSeverity.Error);
    return errors.sort((one, other) => one.range.start.compareTo(other.range.start))[0];
  }

  private sayBlocked(): void {
    this.say({ type: "blocked", obstacle: obstacle(this.server.state, vscode.workspace.isTrusted) });
  }

  private passOn(tile: protocol.Tile): void {
    if (tile.preview === this.id("mirage") || tile.preview === this.id("straight")) {
      this.say({ type: "tile", tile });
    }
  }

  // --- from the page -------------------------------------------------------------------------------------------

  private async take(message: FromPage): Promise<void> {
    switch (message.type) {
      case "ready":
        this.isReady = true;
        this.say({ type: "options", options: { ...this.settings.options, pinned: this.isPinned } });
        this.say({ type: "visible", visible: this.panel.visible });
        this.sayBlocked();
        this.sayScene(true);
        break;
      case "render":
      case "pick":
      case "mask":
        await this.answer(message.id, this.ask(message));
        break;
      case "reveal":
        await this.reveal(message.hit, message.whole);
        break;
      case "save":
        await savePicture(this.server, this.document, message.optics, this.settings.options.render);
        break;
      case "pin":
        this.pin(message.pinned);
        break;
      case "action":
        await carryOut(message.action);
        break;
      case "problem": {
        const problem = this.problem();
        if (problem !== undefined) {
          await reveal(this.document.uri, problem.range);
        }
        break;
      }
      case "output":
        this.server.output.show();
        break;
    }
  }

  private async answer(id: number, answer: Promise<Rendered | Hit | Mask | null>): Promise<void> {
    try {
      this.say({ type: "answer", id, answer: await answer });
    } catch (fault) {
      this.say({ type: "failed", id, message: fault instanceof Error ? fault.message : String(fault) });
    }
  }

  private ask(message: Extract<FromPage, { id: number }>): Promise<Rendered | Hit | Mask | null> {
    switch (message.type) {
      case "render":
        return this.render(message);
      case "pick":
        return this.pick(message);
      case "mask":
        return this.mask(message);
    }
  }

  private render({ id, request }: Extract<FromPage, { type: "render" }>): Promise<Rendered> {
    const which = { textDocument: { uri: this.uri }, preview: this.id(request.optics), job: id };
    return this.server.request(protocol.render, { ...which, ...request });
  }

  private async pick({ optics, pixel }: Extract<FromPage, { type: "pick" }>): Promise<Hit | null> {
    const pick = await this.server.request(protocol.pick, { preview: this.id(optics), ...pixel });
    if (pick === null) {
      return null;
    }
    return { ...pick, version: this.document.version, line: pick.range.start.line + 1 };
  }

  private async mask({ optics }: Extract<FromPage, { type: "mask" }>): Promise<Mask | null> {
    const editor = [vscode.window.activeTextEditor, ...vscode.window.visibleTextEditors].find(
      (editor) => editor?.document === this.document,
    );
    if (editor === undefined || !this.settings.highlightCursor) {
      return null;
    }
    const { line, character } = editor.selection.active;
    return this.server.request(protocol.mask, { preview: this.id(optics), position: { line, character } });
  }

  private async reveal(hit: Hit, whole: boolean): Promise<void> {
    const range = (whole ? hit.solidRange : hit.range) as protocol.Picked["range"];
    await reveal(this.document.uri, this.scenes.rangeNow(this.document.uri, hit.version, range));
  }

  private title(): void {
    const name = path.basename(this.document.uri.path);
    this.panel.title = this.isPinned ? `[Preview ${name}]` : `Preview ${name}`;
  }

  private dispose(): void {
    this.isReady = false;
    this.listening.dispose();
    for (const optics of ["mirage", "straight"] as const) {
      // It does not matter whether the server still knows it.
      this.server.request(protocol.close, { preview: this.id(optics) }).catch(() => undefined);
    }
    this.disposed.fire();
    this.disposed.dispose();
    this.pinnedChanged.dispose();
  }
}
