/** Shows a place of a scene in its editor: the cursor at its beginning, and the whole lit until that moves on. */

import * as vscode from "vscode";

const lit = vscode.window.createTextEditorDecorationType({
  backgroundColor: new vscode.ThemeColor("editor.rangeHighlightBackground"),
  borderColor: new vscode.ThemeColor("editor.rangeHighlightBorder"),
});

/** In the editor that shows the scene already, if there is one. */
export async function reveal(uri: vscode.Uri, range: vscode.Range): Promise<void> {
  const shown = vscode.window.visibleTextEditors.find((editor) => editor.document.uri.toString() === uri.toString());
  const editor = await vscode.window.showTextDocument(uri, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.One });
  editor.selection = new vscode.Selection(range.start, range.start);
  editor.revealRange(range, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
  editor.setDecorations(lit, [range]);
  const listening = vscode.window.onDidChangeTextEditorSelection(({ textEditor, selections }) => {
    if (textEditor === editor && selections[0]?.active.isEqual(range.start) !== true) {
      editor.setDecorations(lit, []);
      listening.dispose();
    }
  });
}
