/**
 * What the language server answers beyond LSP: docs/protocol.md, in types. Those of previews are mirage3d-picture's.
 *
 * Ranges are LSP's. They hold for the text as it stands when the answer comes, whatever version it was made from.
 */

import { NotificationType, RequestType } from "vscode-languageclient/node";
import type { Position, Range, TextDocumentIdentifier } from "vscode-languageclient/node";

import type { Notifications, Requests } from "mirage3d-picture/protocol";

export type { Mask, Picked, RenderOptions, Saved, Tile } from "mirage3d-picture/protocol";

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

interface OfDocument {
  textDocument: TextDocumentIdentifier;
}

export const analysed = new NotificationType<Analysed>("m3d/analysed");
export const tile = new NotificationType<Notifications["m3d/preview/tile"]>("m3d/preview/tile");

export const dump = new RequestType<OfDocument & { position?: Position }, Dump | null, void>("m3d/dump");
export const irTree = new RequestType<OfDocument, Tree | null, void>("m3d/irTree");
export const syntaxTree = new RequestType<OfDocument, Tree | null, void>("m3d/syntaxTree");

type Asked<M extends keyof Requests> = RequestType<Requests[M]["params"], Requests[M]["answer"], void>;
const request = <M extends keyof Requests>(method: M): Asked<M> => new RequestType(method);

export const render = request("m3d/preview/render");
export const pick = request("m3d/preview/pick");
export const mask = request("m3d/preview/mask");
export const save = request("m3d/preview/save");
export const close = request("m3d/preview/close");
