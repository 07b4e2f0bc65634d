/** A picture as it comes in: tiles of squares, coarse to fine, painted over one another. */

import type { Bytes, Tile } from "./protocol";

export class Bitmap {
  readonly width: number;
  readonly height: number;
  /** Rows of red, green, blue, alpha. */
  readonly data: Uint8ClampedArray<ArrayBuffer>;
  /** The smallest step of each row's pixels; 0: the row is of a picture before, or empty. */
  private readonly steps: Uint16Array;

  constructor(width: number, height: number) {
    this.width = width;
    this.height = height;
    this.data = new Uint8ClampedArray(width * height * 4);
    this.steps = new Uint16Array(height);
  }

  /** The picture before, stretched to a new size, to be painted over. */
  static over(before: Bitmap | null, width: number, height: number): Bitmap {
    const bitmap = new Bitmap(width, height);
    if (before === null) {
      return bitmap;
    }
    const from = new Uint32Array(before.data.buffer);
    const to = new Uint32Array(bitmap.data.buffer);
    for (let y = 0; y < height; y++) {
      const row = Math.floor((y * before.height) / height) * before.width;
      for (let x = 0; x < width; x++) {
        to[y * width + x] = from[row + Math.floor((x * before.width) / width)] ?? 0;
      }
    }
    return bitmap;
  }

  /** Paints a tile of this picture's size. What reaches beyond the picture is left out. */
  paint(tile: Tile): void {
    const { data, width, height } = this;
    const pixels = bytes(tile.pixels);
    for (let row = 0; row < tile.rows; row++) {
      const top = tile.top + row * tile.step;
      const bottom = Math.min(top + tile.step, height);
      for (let y = top; y < bottom; y++) {
        const line = y * width;
        for (let column = 0; column < tile.columns; column++) {
          const from = (row * tile.columns + column) * 3;
          const right = Math.min((column + 1) * tile.step, width);
          for (let x = column * tile.step; x < right; x++) {
            const to = (line + x) * 4;
            data[to] = pixels[from] ?? 0;
            data[to + 1] = pixels[from + 1] ?? 0;
            data[to + 2] = pixels[from + 2] ?? 0;
            data[to + 3] = 255;
          }
        }
        this.steps[y] = tile.step;
      }
    }
  }

  /** How much of the finished picture is there: 0 to 1. */
  get progress(): number {
    const done = this.steps.reduce((sum, step) => sum + (step === 0 ? 0 : 1 / (step * step)), 0);
    return this.height === 0 ? 1 : done / this.height;
  }

  /** Red, green and blue, 0 to 1; null outside, and where nothing has been painted. */
  color(x: number, y: number): [number, number, number] | null {
    if (x < 0 || y < 0 || x >= this.width || y >= this.height) {
      return null;
    }
    const [red = 0, green = 0, blue = 0, alpha = 0] = this.data.subarray((y * this.width + x) * 4);
    return alpha === 0 ? null : [red / 255, green / 255, blue / 255];
  }
}

function bytes(given: Bytes): Uint8Array {
  return typeof given === "string" ? Uint8Array.from(atob(given), (letter) => letter.charCodeAt(0)) : given;
}
