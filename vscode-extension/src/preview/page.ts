/** The HTML of a preview: one script and one style sheet of the extension, and nothing else may be loaded. */

import { randomBytes } from "node:crypto";
import * as vscode from "vscode";

export function page(webview: vscode.Webview, extension: vscode.Uri): string {
  const file = (name: string): string => webview.asWebviewUri(vscode.Uri.joinPath(extension, "dist", name)).toString();
  const nonce = randomBytes(16).toString("base64");
  const policy = `default-src 'none'; script-src 'nonce-${nonce}'; style-src ${webview.cspSource};`;
  return `<!DOCTYPE html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta http-equiv="Content-Security-Policy" content="${policy}" />
    <link rel="stylesheet" href="${file("preview.css")}" />
    <title>Mirage3D preview</title>
  </head>
  <body>
    <script nonce="${nonce}" src="${file("preview.js")}"></script>
  </body>
</html>
`;
}
