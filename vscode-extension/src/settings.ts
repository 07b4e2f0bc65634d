/** The settings that the extension itself reads; the others are the language server's. */

import * as vscode from "vscode";

import type { Options, Show } from "mirage3d-picture/host";

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
      samples: settings.get<number>("samples", 1),
    },
    renderOn: settings.get<"type" | "save">("renderOn", "type"),
    highlightCursor: settings.get<boolean>("highlightCursor", true),
  };
}
