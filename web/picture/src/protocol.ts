/** What is said about previews. Made by `make generate` from protocol/preview.toml. */

/** As they are, or as base64 where JSON is in between. */
export type Bytes = Uint8Array | string;

export interface Position {
  line: number;
  character: number;
}

export interface Range {
  start: Position;
  end: Position;
}

/** Whether the air bends light. A scene without MIRAGE is the same with both. */
export type Optics = "straight" | "mirage";

/** How a request ended. It is cancelled by a newer request for the preview, a cancellation or `close`. */
export type Status = "done" | "cancelled" | "error";

/** How a ray ends: at a surface, or as `m3d-rays` says. Without MIRAGE the range is that of the scene's things. */
export type End = "ground" | "top" | "range" | "segments" | "hit";

/** Full rows of a picture, each pixel for a square of `step` picture pixels. */
export interface Tile {
  /** The preview that it belongs to. */
  preview: string;
  /** The job that the request gave. */
  job?: number | null;
  /** The document's version. */
  version: number;
  /** Columns of the picture. */
  width: number;
  /** Rows of the picture. */
  height: number;
  /** The tile's first picture row. */
  top: number;
  /** Picture pixels that a pixel stands for, across and down. */
  step: number;
  /** Pixels in a row of the tile. */
  columns: number;
  /** Rows of the tile. */
  rows: number;
  /** `rows` x `columns` x (red, green, blue), a byte each. */
  pixels: Bytes;
}

/** What became of a picture. */
export interface Rendered {
  /** How the request ended. */
  status: Status;
  /** The version of the text that the picture is of. */
  version: number;
  /** The text has errors, and the picture is of its last version without. */
  stale: boolean;
  /** Columns of the picture. */
  width: number;
  /** Rows of the picture. */
  height: number;
  /** How many times as tall as wide a pixel is to be shown: 1 with `fill`, else the scene's ASPECT. */
  aspect: number;
  /** The scene's WIDTH. */
  ownWidth: number;
  /** The scene's HEIGHT. */
  ownHeight: number;
  /** How long it took. */
  seconds: number;
  /** Whether the scene's air bends light at all. */
  bent: boolean;
  /** For people, when the status is `"error"`. */
  message?: string | null;
}

/** The ray through a pixel. */
export interface Path {
  /** Its length. */
  length: number;
  /** Of how many arcs it is made. */
  arcs: number;
}

/** What a pixel shows. */
export interface Picked {
  /** The version that the picture was made of. */
  version: number;
  /** The text of the primitive. */
  range: Range;
  /** The text of its solid or light. */
  solidRange: Range;
  /** The solid's row in the IR; -1 for a light. */
  solid: number;
  /** The primitive's row in the IR. */
  primitive: number;
  /** Red, green and blue, 0 to 1. */
  color: [number, number, number];
  /** The point in the scene. */
  position: [number, number, number];
  /** The unit vector that shades. */
  normal: [number, number, number];
  /** Distance along the direction of view. */
  depth: number;
  /** The primitive's own coordinates. */
  uv: [number, number];
  /** The way of the light. */
  path: Path;
}

/** Where the picture shows the solid or light whose text is at a position. */
export interface Mask {
  /** The version that the picture was made of. */
  version: number;
  /** Columns of the picture. */
  width: number;
  /** Rows of the picture. */
  height: number;
  /** `[row, first column, end column]` of each run of pixels. */
  runs: [number, number, number][];
  /** That text. */
  range: Range;
}

/** The ray through a pixel, in the vertical plane through it and the eye. A straight one has two points. */
export interface Ray {
  /** `[r, z]` at the eye, at each change of layer and at the end: horizontal distance from the eye, and height. */
  points: [number, number][];
  /** How it ends. */
  end: End;
}

/** What became of a picture's file. */
export interface Saved {
  /** How the request ended. */
  status: Status;
  /** The file. */
  path: string;
  /** For people, when the status is `"error"`. */
  message?: string | null;
}

/** What may be asked of a picture. */
export interface RenderOptions {
  /** Rays a pixel, spread by a smooth filter: no jagged edges (1). */
  samples?: number;
}

export const RENDER_OPTION_NAMES = ["samples"] as const;

/** What is meant where an option is not given; one that is not here is then as the scene says. */
export const RENDER_OPTIONS: RenderOptions = {
  samples: 1,
};

/** Suffixes of the picture files that can be saved, by what a file dialog calls them. */
export const PICTURE_FORMATS: Record<string, string[]> = {
  "PNG, 8 bits": ["png"],
  "TIFF, 16 bits": ["tif", "tiff"],
  "OpenEXR, floating point": ["exr"],
};

/** Makes a picture. */
export interface RenderParams extends RenderOptions {
  /** The scene. */
  textDocument: { uri: string };
  /** Which of the client's pictures. */
  preview: string;
  /** Whether the air bends light. */
  optics: Optics;
  /** Any number of the client's: the tiles of this picture name it. */
  job?: number;
  /** Columns that it may have. */
  maxWidth?: number;
  /** Rows that it may have. */
  maxHeight?: number;
  /**
   * It is as large as fits, be it larger than the scene's own size, and its pixels are square: the scene's ASPECT is
   * undone, so that balls look round.
   */
  fill?: boolean;
}

/** What a pixel shows; null: nothing. */
export interface PickParams {
  /** The picture. */
  preview: string;
  /** Column. */
  x: number;
  /** Row. */
  y: number;
  /** Columns of the picture that is meant. */
  width?: number;
  /** Rows of it. */
  height?: number;
}

/** Where the picture shows what stands at a place of the text; null: nothing stands there. */
export interface MaskParams {
  /** The picture. */
  preview: string;
  /** The place. */
  position?: Position;
}

/** The way of the light to a pixel; null where there is no picture. */
export interface RayParams {
  /** The picture. */
  preview: string;
  /** Column. */
  x: number;
  /** Row. */
  y: number;
  /** Columns of the picture that is meant. */
  width?: number;
  /** Rows of it. */
  height?: number;
}

/** Writes the picture at the scene's own size into a file. */
export interface SaveParams extends RenderOptions {
  /** The scene. */
  textDocument: { uri: string };
  /** Whether the air bends light. */
  optics: Optics;
  /** The file; its suffix names the format. */
  path: string;
  /** LSP's, for its progress. */
  workDoneToken?: string | number;
}

/** The client shows a preview no longer. */
export interface CloseParams {
  /** The picture. */
  preview: string;
}

/** The requests, by their methods. */
export interface Requests {
  "m3d/preview/render": { params: RenderParams; answer: Rendered };
  "m3d/preview/pick": { params: PickParams; answer: Picked | null };
  "m3d/preview/mask": { params: MaskParams; answer: Mask | null };
  "m3d/preview/ray": { params: RayParams; answer: Ray | null };
  "m3d/preview/save": { params: SaveParams; answer: Saved };
  "m3d/preview/close": { params: CloseParams; answer: null };
}

/** The notifications, by their methods. */
export interface Notifications {
  "m3d/preview/tile": Tile;
}
