/** Draws onto the canvas: one picture or two under the divider, the mask of a thing, and the pixel pointed at. */

import type { Bitmap } from "./bitmap";
import type { Mask, Optics, Pixel, Show } from "./host";
import type { Viewport } from "./viewport";

export interface Layer {
  bitmap: Bitmap | null;
  mask: Mask | null;
}

export interface Look {
  show: Show;
  /** Where the two pictures meet, as a part of the picture's width; the mirage is to the left of it. */
  divider: number;
  layers: Record<Optics, Layer>;
  /** The pixel pointed at. */
  pixel: Pixel | null;
}

/** Below this many pixels of the pane for one of the picture its pixels are blended, above they are squares. */
const SQUARES_FROM = 3;

export class Stage {
  private readonly context: CanvasRenderingContext2D;
  private readonly copies = new Map<Optics, HTMLCanvasElement>();

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly viewport: Viewport,
  ) {
    const context = canvas.getContext("2d");
    if (context === null) {
      throw new Error("this browser has no canvas to draw on");
    }
    this.context = context;
  }

  /** Makes the canvas as fine as the screen; its size is that of the pane, in CSS pixels. */
  resize(width: number, height: number, ratio: number): void {
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
  }

  /** The bitmap has changed since it was drawn last. */
  update(optics: Optics, bitmap: Bitmap | null): void {
    const copy = this.copies.get(optics) ?? document.createElement("canvas");
    this.copies.set(optics, copy);
    if (bitmap === null) {
      copy.width = copy.height = 0;
      return;
    }
    if (copy.width !== bitmap.width || copy.height !== bitmap.height) {
      copy.width = bitmap.width;
      copy.height = bitmap.height;
    }
    copy.getContext("2d")?.putImageData(new ImageData(bitmap.data, bitmap.width, bitmap.height), 0, 0);
  }

  draw(look: Look): void {
    const { context, canvas } = this;
    const ratio = canvas.clientWidth === 0 ? 1 : canvas.width / canvas.clientWidth;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, canvas.width / ratio, canvas.height / ratio);
    if (look.show === "both") {
      this.drawPart("straight", look, look.divider, 1);
      this.drawPart("mirage", look, 0, look.divider);
    } else {
      this.drawPart(look.show, look, 0, 1);
    }
    this.drawPixel(look);
  }

  /** A picture between two parts of its width. */
  private drawPart(optics: Optics, look: Look, from: number, to: number): void {
    const { context } = this;
    const { bitmap, mask } = look.layers[optics];
    const copy = this.copies.get(optics);
    if (bitmap === null || copy === undefined || copy.width === 0) {
      return;
    }
    const { x, y, width, height } = this.viewport.frame;
    context.save();
    context.beginPath();
    context.rect(x + from * width, y, (to - from) * width, height);
    context.clip();
    context.imageSmoothingEnabled = width / bitmap.width < SQUARES_FROM;
    context.drawImage(copy, x, y, width, height);
    if (mask !== null) {
      this.drawMask(mask);
    }
    context.restore();
  }

  /** Outlines the runs, light on dark so that it is seen on any colour. */
  private drawMask(mask: Mask): void {
    const { context } = this;
    const { x, y, width, height } = this.viewport.frame;
    const dx = width / mask.width;
    const dy = height / mask.height;
    const outline = edges(mask);
    for (const [style, line] of [
      ["rgba(0, 0, 0, 0.85)", 3],
      ["rgba(255, 255, 255, 0.95)", 1],
    ] as const) {
      context.strokeStyle = style;
      context.lineWidth = line;
      context.beginPath();
      for (const [x0, y0, x1, y1] of outline) {
        context.moveTo(x + x0 * dx, y + y0 * dy);
        context.lineTo(x + x1 * dx, y + y1 * dy);
      }
      context.stroke();
    }
  }

  private drawPixel(look: Look): void {
    if (look.pixel === null) {
      return;
    }
    const { context } = this;
    const { x, y, width, height } = this.viewport.frame;
    const { pixel } = look;
    const dx = Math.max(width / pixel.width, 7);
    const dy = Math.max(height / pixel.height, 7);
    const middle = { x: x + ((pixel.x + 0.5) * width) / pixel.width, y: y + ((pixel.y + 0.5) * height) / pixel.height };
    for (const [style, line] of [
      ["black", 3],
      ["white", 1],
    ] as const) {
      context.strokeStyle = style;
      context.lineWidth = line;
      context.strokeRect(middle.x - dx / 2, middle.y - dy / 2, dx, dy);
    }
  }
}

/** The border of the pixels of a mask: line segments `[x0, y0, x1, y1]` along pixel edges. */
export function edges(mask: Mask): [number, number, number, number][] {
  const rows = new Map<number, [number, number][]>();
  for (const [row, first, end] of mask.runs) {
    const runs = rows.get(row) ?? [];
    runs.push([first, end]);
    rows.set(row, runs);
  }
  const found: [number, number, number, number][] = [];
  for (const [row, runs] of rows) {
    for (const [first, end] of runs) {
      found.push([first, row, first, row + 1], [end, row, end, row + 1]);
      for (const [from, to] of without([first, end], rows.get(row - 1) ?? [])) {
        found.push([from, row, to, row]);
      }
      for (const [from, to] of without([first, end], rows.get(row + 1) ?? [])) {
        found.push([from, row + 1, to, row + 1]);
      }
    }
  }
  return found;
}

/** The parts of an interval that lie in none of the others. */
function without(interval: [number, number], others: [number, number][]): [number, number][] {
  const parts: [number, number][] = [];
  let [at] = interval;
  for (const [first, end] of [...others].sort((one, other) => one[0] - other[0])) {
    if (end <= at || first >= interval[1]) {
      continue;
    }
    if (first > at) {
      parts.push([at, first]);
    }
    at = end;
  }
  if (at < interval[1]) {
    parts.push([at, interval[1]]);
  }
  return parts;
}
