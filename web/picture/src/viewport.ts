/**
 * Where the picture lies in its pane: fitted, or zoomed and moved.
 *
 * Lengths are of the pane's pixels. The picture has a size of its own, that of its last full rendering; a coarser one
 * is shown at the same place, as large.
 */

import type { Pixel } from "./host";

export interface Point {
  x: number;
  y: number;
}

const LARGEST_ZOOM = 64;

export class Viewport {
  private pane = { width: 1, height: 1 };
  private picture = { width: 1, height: 1 };
  /** The pane's pixels for one of the picture; null: as many as fit. */
  private zoom: number | null = null;
  /** The picture's point, as fractions of its size, in the middle of the pane. */
  private middle: Point = { x: 0.5, y: 0.5 };

  setPane(width: number, height: number): void {
    this.pane = { width: Math.max(width, 1), height: Math.max(height, 1) };
  }

  setPicture(width: number, height: number): void {
    this.picture = { width: Math.max(width, 1), height: Math.max(height, 1) };
  }

  get fitted(): boolean {
    return this.zoom === null;
  }

  /** The pane's pixels for one of the picture. */
  get scale(): number {
    const { pane, picture } = this;
    return this.zoom ?? Math.min(pane.width / picture.width, pane.height / picture.height);
  }

  /** Where the picture is drawn. */
  get frame(): { x: number; y: number; width: number; height: number } {
    const width = this.picture.width * this.scale;
    const height = this.picture.height * this.scale;
    const { x, y } = this.zoom === null ? { x: 0.5, y: 0.5 } : this.middle;
    return { x: this.pane.width / 2 - x * width, y: this.pane.height / 2 - y * height, width, height };
  }

  fit(): void {
    this.zoom = null;
    this.middle = { x: 0.5, y: 0.5 };
  }

  /** Makes the picture larger by a factor, its point at `about` staying where it is. */
  zoomBy(factor: number, about: Point = { x: this.pane.width / 2, y: this.pane.height / 2 }): void {
    this.zoomTo(this.scale * factor, about);
  }

  zoomTo(scale: number, about: Point = { x: this.pane.width / 2, y: this.pane.height / 2 }): void {
    const fixed = this.fraction(about);
    const smallest = 0.1 * Math.min(this.pane.width / this.picture.width, this.pane.height / this.picture.height, 1);
    this.zoom = Math.min(Math.max(scale, smallest), LARGEST_ZOOM);
    this.middle = {
      x: fixed.x - (about.x - this.pane.width / 2) / (this.picture.width * this.zoom),
      y: fixed.y - (about.y - this.pane.height / 2) / (this.picture.height * this.zoom),
    };
    this.keepInSight();
  }

  /** Moves the picture, in pixels of the pane. */
  moveBy(x: number, y: number): void {
    const { width, height } = this.frame;
    this.zoom = this.scale;
    this.middle = { x: this.middle.x - x / width, y: this.middle.y - y / height };
    this.keepInSight();
  }

  /** The point of the picture that is at a point of the pane, as fractions of its size: 0 to 1 within it. */
  fraction(point: Point): Point {
    const { x, y, width, height } = this.frame;
    return { x: (point.x - x) / width, y: (point.y - y) / height };
  }

  private keepInSight(): void {
    const clamp = (value: number): number => Math.min(Math.max(value, 0), 1);
    this.middle = { x: clamp(this.middle.x), y: clamp(this.middle.y) };
  }
}

/** Whether a place, as fractions of the picture's size, lies within it. */
export function isInside({ x, y }: Point): boolean {
  return 0 <= x && x < 1 && 0 <= y && y < 1;
}

/** The pixel that a picture has at such a place. Pictures of one scene in several sizes have there what is the same. */
export function pixelAt({ x, y }: Point, { width, height }: { width: number; height: number }): Pixel {
  return { x: Math.floor(x * width), y: Math.floor(y * height), width, height };
}
