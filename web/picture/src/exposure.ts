/**
 * One picture of the scene, with straight or with bent light: when it is rendered anew, and what is shown meanwhile.
 *
 * While the text changes, small pictures are made, each wholly, so that something new is seen however fast one types;
 * a full one follows when the text has rested. A change ends a full one at once. Where full ones are made fast, small
 * ones are not needed. The last good picture stays until there is something to paint over it, and comes back if that
 * ends in an error.
 */

import { Bitmap } from "./bitmap";
import type { Host, Optics, Rendered, RenderRequest } from "./host";

export type Quality = "draft" | "full";

/** A full picture made in fewer seconds than this is fast: it keeps up with the keys. */
const FAST = 0.2;

/** How pictures are made, and how large they may be; without numbers, as large as the scene says. */
export type Limits = Omit<RenderRequest, "optics">;

export class Exposure {
  /** What is to be seen: what is being made over the last good picture, or that. */
  shown: Bitmap | null = null;
  /** The answer that came with the last good picture. */
  answer: Rendered | null = null;
  /** The size of the last full picture, the shape of its pixels, and whether it would have been larger elsewhere. */
  full: { width: number; height: number; aspect: number; limited: boolean } | null = null;
  /** Why the last rendering failed. */
  error: string | null = null;

  private good: Bitmap | null = null;
  /** What the last full picture was made with. */
  private made: Limits | null = null;
  private running: { quality: Quality; limits: Limits } | null = null;
  /** What has come of the one that is being made. */
  private painted: Bitmap | null = null;
  /** Seconds that the last full picture took; without end if it was overtaken. */
  private took = Infinity;
  private next: { quality: Quality; limits: Limits } | null = null;
  private round = 0;

  /** `changed` is called whenever anything here has changed, `finished` when a picture is whole. */
  constructor(
    readonly optics: Optics,
    private readonly host: Host,
    private readonly changed: () => void,
    private readonly finished: () => void,
  ) {}

  get rendering(): boolean {
    return this.running !== null;
  }

  get progress(): number {
    return this.running === null ? 1 : (this.painted?.progress ?? 0);
  }

  /** Whether full pictures are made fast enough to follow the keys. */
  get isFast(): boolean {
    return this.took < FAST;
  }

  /** Whether the full picture of this version, made like this, is there. */
  isWhole(version: number, limits: Limits): boolean {
    const { made, answer } = this;
    return made !== null && isSame(made, limits) && answer?.version === version && this.running === null;
  }

  /** Asks for a picture of the scene as it is. */
  request(quality: Quality, limits: Limits): void {
    if (this.running?.quality === "draft") {
      this.next = { quality, limits };
      return;
    }
    if (this.running !== null) {
      this.took = Infinity;
    }
    void this.render(quality, limits);
  }

  /** Forgets the picture: it is of another scene. */
  clear(): void {
    this.round++;
    this.shown = this.good = this.made = this.answer = this.full = this.error = this.running = this.next = null;
    this.painted = null;
    this.took = Infinity;
    this.changed();
  }

  private async render(quality: Quality, limits: Limits): Promise<void> {
    const round = ++this.round;
    this.running = { quality, limits };
    this.next = null;
    this.changed();
    const request: RenderRequest = { optics: this.optics, ...limits };
    this.painted = null;
    let answer: Rendered;
    try {
      answer = await this.host.render(request, (tile) => {
        if (round !== this.round) {
          return;
        }
        this.painted ??= Bitmap.over(this.shown, tile.width, tile.height);
        this.painted.paint(tile);
        this.shown = this.painted;
        this.changed();
      });
    } catch (fault) {
      answer = failed(fault);
    }
    if (round !== this.round) {
      return;
    }
    this.running = null;
    this.take(answer, quality, limits);
    this.goOn();
    this.changed();
    if (answer.status === "done") {
      this.finished();
    }
  }

  /** Begins what was asked for meanwhile. */
  private goOn(): void {
    if (this.next !== null) {
      void this.render(this.next.quality, this.next.limits);
    }
  }

  private take(answer: Rendered, quality: Quality, limits: Limits): void {
    if (answer.status === "error") {
      this.error = answer.message ?? "The picture could not be rendered.";
      this.shown = this.good;
    } else if (answer.status === "done") {
      this.error = null;
      this.answer = answer;
      this.good = this.shown;
      this.made = quality === "full" ? limits : null;
      this.took = quality === "full" ? answer.seconds : this.took;
      if (quality === "full" || this.full === null) {
        const { width, height, aspect } = answer;
        const { maxWidth = Infinity, maxHeight = Infinity } = limits;
        this.full = { width, height, aspect, limited: width >= maxWidth - 1 || height >= maxHeight - 1 };
      }
    }
  }
}

/** Whether two objects have the same members. */
export function isSame<T extends object>(one: T, other: T): boolean {
  const names = Object.keys({ ...one, ...other }) as (keyof T)[];
  return names.every((name) => one[name] === other[name]);
}

function failed(fault: unknown): Rendered {
  const message = fault instanceof Error ? fault.message : String(fault);
  const none = { version: 0, stale: false, width: 0, height: 0, aspect: 1, ownWidth: 0, ownHeight: 0 };
  return { status: "error", ...none, seconds: 0, bent: false, message };
}
