/**
 * What the picture part needs from whoever shows it, and what it is told. It knows no editor: a host is anything that
 * can render a scene and show a place of its text.
 *
 * Rows, columns and versions are whole numbers; pixels count from the upper left of the picture last rendered.
 */

export type Optics = "straight" | "mirage";

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

export interface RenderRequest {
  optics: Optics;
  /** The picture is made smaller, keeping its proportions, to fit; without, it has the scene's own size. */
  maxWidth?: number;
  maxHeight?: number;
  /** It is as large as fits, be it larger than the scene's own size, with square pixels. */
  fill?: boolean;
  /** Rays a pixel; 1 without. */
  samples?: number;
}

/** Full rows of a picture, `columns` x `rows` pixels, each for a square of `step` picture pixels. */
export interface Tile {
  width: number;
  height: number;
  top: number;
  step: number;
  columns: number;
  rows: number;
  /** Red, green, blue, 0 to 255. */
  pixels: Uint8Array;
}

export interface Rendered {
  status: "done" | "cancelled" | "error";
  version: number;
  /** The text has errors, and the picture is of its last version without. */
  stale: boolean;
  width: number;
  height: number;
  /** How many times as tall as wide a pixel is to be shown. */
  aspect: number;
  /** The scene's own size. */
  ownWidth: number;
  ownHeight: number;
  seconds: number;
  /** Whether the scene's air bends light at all. */
  bent: boolean;
  /** For people, when the status is "error". */
  message?: string | null;
}

/** What a pixel shows. */
export interface Hit {
  /** The version of the text that the places are of. */
  version: number;
  range: Place;
  solidRange: Place;
  /** Where it is written, for people: a line number. */
  line: number;
  solid: number;
  primitive: number;
  color: [number, number, number];
  position: [number, number, number];
  normal: [number, number, number];
  depth: number;
  path: { length: number; arcs: number };
}

/** Where a thing is seen: `[row, first column, end column]` of a picture of this size. */
export interface Mask {
  width: number;
  height: number;
  runs: [number, number, number][];
}

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
  samples: number;
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
