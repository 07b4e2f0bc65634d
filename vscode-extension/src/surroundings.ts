/** This machine and this workspace, as far as finding programs needs them. */

import * as fs from "node:fs";
import * as os from "node:os";
import * as vscode from "vscode";

import { findProgram, findServer, type Found, type Missing, type Surroundings } from "./programs";
import { serverPath } from "./settings";

export function surroundings(): Surroundings {
  return {
    setting: serverPath(),
    folders: (vscode.workspace.workspaceFolders ?? []).map((folder) => folder.uri.fsPath),
    trusted: vscode.workspace.isTrusted,
    path: process.env.PATH ?? "",
    home: os.homedir(),
    windows: process.platform === "win32",
    runnable,
  };
}

export function server(): Found | Missing {
  return findServer(surroundings());
}

/** The path of m3dc or m3d-render. */
export function program(name: "m3dc" | "m3d-render"): string {
  return findProgram(name, server(), surroundings());
}

function runnable(file: string): boolean {
  try {
    fs.accessSync(file, fs.constants.X_OK);
    return fs.statSync(file).isFile();
  } catch {
    return false;
  }
}
