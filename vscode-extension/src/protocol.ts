/**
 * What the language server answers beyond LSP: docs/protocol.md, in types.
 *
 * Ranges are LSP's. They hold for the text as it stands when the answer comes, whatever version it was made from.
 */

import { NotificationType, RequestType } from "vscode-languageclient/node";
import type { Position, Range, TextDocumentIdentifier } from "vscode-languageclient/node";

import type { Optics, Pixel, Rendered } from "mirage3d-picture/host";

/** What this client has for the server: commands for code lenses, and ears for m3d/analysed. */
export const experimental = {
  m3d: { commands: ["m3d.preview", "m3d.render", "m3d.dump", "m3d.showReferences"], analysed: true },
};

export interface Analysed {
  uri: string;
  version: number;
  ok: boolean;
}

export interface Dump {
  version: number;
  stale: boolean;
  text: string;
  /** For each line of the text what it tells of. */
  ranges: (Range | null)[];
}

export interface Node {
  label: string;
  description?: string | null;
  range?: Range | null;
  children?: Node[] | null;
}

export interface Tree {
  version: number;
  stale: boolean;
  nodes: Node[];
}

export interface RenderParams {
  textDocument: TextDocumentIdentifier;
  preview: string;
  optics: Optics;
  maxWidth?: number;
  maxHeight?: number;
  samples?: number;
}

export interface Tile {
  preview: string;
  version: number;
  width: number;
  height: number;
  top: number;
  step: number;
  columns: number;
  rows: number;
  /** Base64. */
  pixels: string;
}

export interface Pick {
  version: number;
  range: Range;
  solidRange: Range;
  solid: number;
  primitive: number;
  color: [number, number, number];
  position: [number, number, number];
  normal: [number, number, number];
  depth: number;
  uv: [number, number] | null;
  path: { length: number; arcs: number };
}

export interface Mask {
  version: number;
  width: number;
  height: number;
  runs: [number, number, number][];
  range: Range;
}

export interface Saved {
  status: "done" | "cancelled" | "error";
  path: string;
  message?: string | null;
}

interface OfDocument {
  textDocument: TextDocumentIdentifier;
}

export const analysed = new NotificationType<Analysed>("m3d/analysed");
export const tile = new NotificationType<Tile>("m3d/preview/tile");

export const dump = new RequestType<OfDocument & { position?: Position }, Dump | null, void>("m3d/dump");
export const irTree = new RequestType<OfDocument, Tree | null, void>("m3d/irTree");
export const syntaxTree = new RequestType<OfDocument, Tree | null, void>("m3d/syntaxTree");
export const render = new RequestType<RenderParams, Rendered, void>("m3d/preview/render");
export const pick = new RequestType<{ preview: string } & Pixel, Pick | null, void>("m3d/preview/pick");
export const mask = new RequestType<{ preview: string; position: Position }, Mask | null, void>("m3d/preview/mask");
export const save = new RequestType<OfDocument & { optics: Optics; path: string; samples?: number }, Saved, void>(
  "m3d/preview/save",
);
export const close = new RequestType<{ preview: string }, null, void>("m3d/preview/close");
