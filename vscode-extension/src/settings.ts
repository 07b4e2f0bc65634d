/** The settings that the extension itself reads; the others are the language server's. */

import * as vscode from "vscode";

import type { Options, Show } from "mirage3d-picture/host";
import { RENDER_OPTION_NAMES } from "mirage3d-picture/protocol";

export function serverPath(): string {
  return vscode.workspace.getConfiguration("m3d").get<string>("server.path", "").trim();
}

export interface PreviewSettings {
  options: Omit<Options, "pinned">;
  renderOn: "type" | "save";
  highlightCursor: boolean;
}

export function previewSettings(scene: vscode.Uri | undefined): PreviewSettings {
  const settings = vscode.workspace.getConfiguration("m3d.preview", scene);
  return {
    options: {
      show: settings.get<Show>("optics", "mirage"),
      typingResolution: settings.get<number>("typingResolution", 0.5),
      resolution: settings.get<"pane" | "scene">("resolution", "pane"),
      render: Object.fromEntries(RENDER_OPTION_NAMES.map((name) => [name, settings.get(name)])),
    },
    renderOn: settings.get<"type" | "save">("renderOn", "type"),
    highlightCursor: settings.get<boolean>("highlightCursor", true),
  };
}
