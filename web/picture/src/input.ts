/** What mouse and keyboard ask of the picture. */

import type { Show } from "./host";
import type { Point } from "./viewport";

export interface Wishes {
  /** The pointer is at a point of the pane; null: it has left. */
  point(at: Point | null): void;
  /** Move from pixel to pixel. */
  step(x: number, y: number): void;
  /** Show where the pixel's thing is written; its whole solid if wished. Without a point: the pixel stepped to. */
  reveal(at: Point | null, whole: boolean): void;
  pan(x: number, y: number): void;
  zoom(factor: number, about?: Point): void;
  fit(): void;
  actual(): void;
  show(show: Show): void;
}

/** How far the pointer may move between press and release for it to be a click. */
const CLICK = 4;

/** How far a key moves the picture. */
const PAN = 40;

export function listenToPointer(canvas: HTMLCanvasElement, wishes: Wishes): void {
  let pressed: Point | null = null;
  let moved = false;
  const at = (event: MouseEvent): Point => {
    const frame = canvas.getBoundingClientRect();
    return { x: event.clientX - frame.left, y: event.clientY - frame.top };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button === 0) {
      pressed = at(event);
      moved = false;
      canvas.setPointerCapture(event.pointerId);
    }
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = at(event);
    if (pressed !== null && (moved || Math.hypot(now.x - pressed.x, now.y - pressed.y) > CLICK)) {
      wishes.pan(now.x - pressed.x, now.y - pressed.y);
      pressed = now;
      moved = true;
    }
    wishes.point(now);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (pressed !== null && !moved) {
      wishes.reveal(at(event), event.shiftKey);
    }
    pressed = null;
  });
  canvas.addEventListener("pointerleave", () => wishes.point(null));
  canvas.addEventListener(
    "wheel",
    (event) => {
      wishes.zoom(Math.exp(-event.deltaY / 400), at(event));
      event.preventDefault();
    },
    { passive: false },
  );
}

export function listenToKeys(canvas: HTMLCanvasElement, wishes: Wishes): void {
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) {
      return;
    }
    if (act(event.key, event.shiftKey, wishes)) {
      event.preventDefault();
    }
  });
}

function act(key: string, shift: boolean, wishes: Wishes): boolean {
  const arrows: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, -1],
    ArrowDown: [0, 1],
  };
  const arrow = arrows[key];
  if (arrow !== undefined) {
    if (shift) {
      wishes.pan(-PAN * arrow[0], -PAN * arrow[1]);
    } else {
      wishes.step(...arrow);
    }
    return true;
  }
  const others: Record<string, () => void> = {
    Enter: () => wishes.reveal(null, shift),
    "+": () => wishes.zoom(1.5),
    "=": () => wishes.zoom(1.5),
    "-": () => wishes.zoom(1 / 1.5),
    "0": () => wishes.fit(),
    "1": () => wishes.actual(),
    m: () => wishes.show("mirage"),
    s: () => wishes.show("straight"),
    b: () => wishes.show("both"),
    Escape: () => wishes.point(null),
  };
  const wish = others[key] ?? others[key.toLowerCase()];
  wish?.();
  return wish !== undefined;
}
