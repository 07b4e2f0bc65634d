/** What the page of a preview and the extension say to each other. */

import type {
  Choice,
  Hit,
  Mask,
  Obstacle,
  Optics,
  Options,
  Pixel,
  Rendered,
  RenderRequest,
  Scene,
  Tile,
} from "mirage3d-picture/host";

/** From the page: questions, which have an id and are answered, and wishes. That of a rendering is its job, too. */
export type FromPage =
  | { type: "render"; id: number; request: RenderRequest }
  | { type: "pick"; id: number; optics: Optics; pixel: Pixel }
  | { type: "mask"; id: number; optics: Optics }
  | { type: "ready" }
  | { type: "reveal"; hit: Hit; whole: boolean }
  | { type: "save"; optics: Optics }
  | { type: "pin"; pinned: boolean }
  | { type: "action"; action: string }
  | { type: "problem" }
  | { type: "output" };

/** What VS Code hands back when it opens the preview again after a restart. */
export interface Kept {
  uri: string;
  pinned: boolean;
  chosen: Choice;
}

export type Answer = Rendered | Hit | Mask | null;

/** To the page: answers, tiles of a rendering that is under way, and events. */
export type ToPage =
  | { type: "answer"; id: number; answer: Answer }
  | { type: "failed"; id: number; message: string }
  | { type: "tile"; tile: Tile }
  | { type: "scene"; scene: Scene }
  | { type: "options"; options: Partial<Options> }
  | { type: "visible"; visible: boolean }
  | { type: "blocked"; obstacle: Obstacle | null }
  | { type: "again" }
  | { type: "cursor" }
  | { type: "save" };
