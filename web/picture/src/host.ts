/**
 * What the picture part needs from whoever shows it, and what it is told. It knows no editor: a host is anything that
 * can render a scene and show a place of its text.
 *
 * Rows, columns and versions are whole numbers; pixels count from the upper left of the picture last rendered.
 */

import type { Mask as WholeMask, Optics, Picked, Rendered, RenderOptions, RenderParams, Tile } from "./protocol";

export type { Optics, Rendered, RenderOptions, Tile };

/** What a preview shows: one of the two, or both under a slider. */
export type Show = Optics | "both";

/** A place in the scene's text, as the host counts it; the picture part only hands it back. */
export type Place = unknown;

/** A pixel of a picture of this size. */
export interface Pixel {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** What is asked of a picture: `RenderParams`, but for what tells the server which. */
export type RenderRequest = Omit<RenderParams, "textDocument" | "preview" | "job">;

/** What a pixel shows, `version` being that of the text that the places are of, and on which line that is written. */
export type Hit = Omit<Picked, "range" | "solidRange" | "uv"> & { range: Place; solidRange: Place; line: number };

/** Where a thing is seen. */
export type Mask = Omit<WholeMask, "version" | "range">;

/** The scene, as far as the picture part must know it. */
export interface Scene {
  /** Tells it from every other. */
  id: string;
  /** For people. */
  name: string;
  /** The version of the text. */
  version: number;
  /** Whether pictures are to be made of this version: not while one waits for a save, or for the check of the text. */
  render: boolean;
  /** This version has errors: what is shown of it is the last one without. */
  errors: boolean;
  /** The first error, for people: where, and what it says. */
  problem: string | null;
}

/** Why there can be no picture, in words for people, and what they can do about it: the host knows how. */
export interface Obstacle {
  reason: string;
  actions: readonly string[];
}

export interface Options {
  show: Show;
  /** The size of the picture while one types, as a part of the full size: 0 to 1. */
  typingResolution: number;
  /** As large as the pane, or the scene's own size. */
  resolution: "pane" | "scene";
  /** Of full pictures. */
  render: RenderOptions;
  pinned: boolean;
}

/** What a person chooses in the preview itself. */
export type Choice = Partial<Pick<Options, "show" | "resolution">>;

/** What happens outside. */
export interface Events {
  /** There is another scene, or its text has changed. */
  scene(scene: Scene): void;
  /** Render again, whatever the picture is like. */
  again(): void;
  /** Only what has changed is given. */
  options(options: Partial<Options>): void;
  /** The cursor in the text has moved: what it is in may be another thing. */
  cursor(): void;
  /** Whether anybody can see the picture; nothing is rendered while nobody can. */
  visible(visible: boolean): void;
  /** Why there can be no picture; null: there can. */
  blocked(obstacle: Obstacle | null): void;
  /** Asks for a picture file, as the button does. */
  save(): void;
}

export interface Host {
  /** Called once, when events can be taken. */
  listen(events: Events): void;
  /** A new request for the same optics ends the one before, whose answer is then "cancelled". */
  render(request: RenderRequest, tile: (tile: Tile) => void): Promise<Rendered>;
  /** What the pixel shows; null: nothing. The host may have a picture of another size by now. */
  pick(optics: Optics, pixel: Pixel): Promise<Hit | null>;
  /** Where the picture shows the thing that the cursor is in; null: the cursor is in none. */
  mask(optics: Optics): Promise<Mask | null>;
  /** Shows where it is written, the primitive alone or its whole solid. */
  reveal(hit: Hit, whole: boolean): void;
  /** Lets a person choose a file, and writes the picture into it. */
  save(optics: Optics): void;
  pin(pinned: boolean): void;
  /** Does one of the things that an obstacle offers. */
  carryOut(action: string): void;
  /** Shows the scene's first error in the text. */
  showProblem(): void;
  /** Shows what the renderer has to say. */
  showOutput(): void;
  /** Something was chosen, for a host that remembers it until it shows the preview again. */
  chose(choice: Choice): void;
}
