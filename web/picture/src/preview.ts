/**
 * A preview: pictures of a scene in an element of a page. It decides what is rendered when, and how large.
 *
 * `new Preview(element, host)` is all there is to do; style.css goes with it.
 */

import { Exposure, isSame, type Limits, type Quality } from "./exposure";
import type { Choice, Events, Hit, Host, Mask, Obstacle, Optics, Options, Scene, Show } from "./host";
import { listenToKeys, listenToPointer } from "./input";
import { Pause } from "./pause";
import { RENDER_OPTIONS } from "./protocol";
import { css, hitText, pictureText, pixelText, unknownText } from "./readout";
import { Stage } from "./stage";
import { badge } from "./state";
import { View } from "./view";
import { isInside, pixelAt, Viewport, type Point } from "./viewport";

/** How long the text has rested before a full picture is made, in ms. */
const REST = 400;

/** How long the keys have rested before the picture follows, in ms: what an editor does at each of them comes first. */
const CALM = 60;

/** How long the pointer has rested before it is asked what it is on, in ms. */
const DWELL = 120;

export class Preview implements Events {
  private readonly viewport = new Viewport();
  private readonly view: View;
  private readonly stage: Stage;
  private readonly exposures: Record<Optics, Exposure>;
  private readonly masks: Record<Optics, Mask | null> = { mirage: null, straight: null };
  private readonly fresh: Record<Optics, boolean> = { mirage: false, straight: false };
  private options_: Options = {
    show: "mirage",
    typingResolution: 0.5,
    resolution: "pane",
    render: RENDER_OPTIONS,
    pinned: false,
  };
  private scene_: Scene | null = null;
  private isVisible = true;
  /** There would have been a rendering, had anybody seen it. */
  private missed = false;
  private obstacle: Obstacle | null = null;
  private divider = 0.5;
  private readonly rested = new Pause(REST, () => this.render("full"));
  private readonly dwelt = new Pause(DWELL, () => void this.ask());
  private readonly calm = {
    picture: new Pause(CALM, () => this.render(this.shown().every(({ isFast }) => isFast) ? "full" : "draft")),
    cursor: new Pause(CALM, () => this.askMasks()),
  };
  /** What is pointed at, by fractions of the picture's size: drafts and full pictures come and go under it. */
  private pointer: { place: Point; optics: Optics; hit: string } | null = null;
  private asked = 0;
  private readonly masksAsked: Record<Optics, number> = { mirage: 0, straight: 0 };
  private drawn = 0;

  constructor(
    root: HTMLElement,
    private readonly host: Host,
  ) {
    const wishes = {
      point: (at: Point | null) => this.point(at),
      step: (x: number, y: number) => this.step(x, y),
      reveal: (at: Point | null, whole: boolean) => void this.reveal(at, whole),
      pan: (x: number, y: number) => this.look(() => this.viewport.moveBy(x, y)),
      zoom: (factor: number, about?: Point) => this.look(() => this.viewport.zoomBy(factor, about)),
      fit: () => this.look(() => this.viewport.fit()),
      actual: () => this.look(() => this.viewport.zoomTo(1 / devicePixelRatio)),
      show: (show: Show) => this.choose({ show }),
    };
    this.view = new View(root, {
      ...wishes,
      wholeSize: (on) => this.choose({ resolution: on ? "scene" : "pane" }),
      save: () => this.save(),
      pin: (pinned) => host.pin(pinned),
      divide: (part) => this.divide(part),
      carryOut: (action) => host.carryOut(action),
      lead: (to) => (to === "again" ? this.again() : to === "problem" ? host.showProblem() : host.showOutput()),
    });
    this.stage = new Stage(this.view.canvas, this.viewport);
    const exposure = (optics: Optics): Exposure =>
      new Exposure(
        optics,
        host,
        () => {
          this.fresh[optics] = false;
          this.refresh();
        },
        () => {
          this.catchUp();
          void this.askMask(optics);
          if (this.pointer?.optics === optics && this.pointer.hit !== "") {
            void this.ask();
          }
        },
      );
    this.exposures = { mirage: exposure("mirage"), straight: exposure("straight") };
    listenToPointer(this.view.canvas, wishes);
    listenToKeys(this.view.canvas, wishes);
    this.view.pane.addEventListener("m3d-drag", (event) => this.drag((event as CustomEvent<number>).detail));
    new ResizeObserver(() => this.resize()).observe(this.view.pane);
    this.resize();
    this.options({});
    host.listen(this);
  }

  // --- what the host tells -------------------------------------------------------------------------------------

  scene(scene: Scene): void {
    if (scene.id !== this.scene_?.id) {
      for (const optics of ["mirage", "straight"] as const) {
        this.exposures[optics].clear();
        this.masks[optics] = null;
      }
      this.viewport.fit();
      this.pointer = null;
    }
    const first = this.shown().every(({ answer }) => answer === null);
    this.scene_ = scene;
    const waits = this.rested.isWaiting || this.calm.picture.isWaiting;
    this.calm.picture.stop();
    // A text with errors has no picture of its own; the last good one is asked for only if it is not there.
    if (scene.render && first) {
      this.render("full");
    } else if (scene.render && !scene.errors) {
      this.calm.picture.start();
    } else if (waits) {
      this.rested.start();
    }
    this.refresh();
  }

  again(): void {
    this.render("full");
  }

  options(options: Partial<Options>): void {
    const before = this.options_;
    this.options_ = { ...before, ...options };
    const { show, resolution, pinned, render } = this.options_;
    this.view.setShow(show);
    this.view.setPinned(pinned);
    this.view.setWholeSize(resolution === "scene");
    if (show !== before.show || resolution !== before.resolution || !isSame(render, before.render)) {
      const version = this.scene_?.version ?? 0;
      this.render(
        "full",
        this.shown().filter((exposure) => !exposure.isWhole(version, this.limits(exposure, "full"))),
      );
    }
    this.refresh();
  }

  cursor(): void {
    this.calm.cursor.start();
  }

  visible(visible: boolean): void {
    this.isVisible = visible;
    if (visible && this.missed) {
      this.render("full");
    }
  }

  blocked(obstacle: Obstacle | null): void {
    const freed = obstacle === null && this.obstacle !== null;
    this.obstacle = obstacle;
    this.view.setObstacle(obstacle);
    if (freed) {
      this.render("full");
    }
    this.refresh();
  }

  save(): void {
    this.host.save(this.pointer?.optics ?? this.shown()[0]?.optics ?? "mirage");
  }

  // --- what a person wishes ------------------------------------------------------------------------------------

  private choose(choice: Choice): void {
    this.options(choice);
    this.host.chose(choice);
  }

  private look(change: () => void): void {
    change();
    this.refresh();
  }

  private divide(part: number): void {
    this.divider = part;
    this.refresh();
  }

  private drag(clientX: number): void {
    const x = clientX - this.view.pane.getBoundingClientRect().left;
    this.divide(Math.min(Math.max(this.viewport.fraction({ x, y: 0 }).x, 0), 1));
  }

  private point(at: Point | null): void {
    this.dwelt.stop();
    const found = at === null ? null : this.find(at);
    this.pointer = found === null ? null : { ...found, hit: "" };
    this.asked++;
    if (found !== null) {
      this.dwelt.start();
    }
    this.refresh();
  }

  private step(x: number, y: number): void {
    const optics = this.pointer?.optics ?? this.shown()[0]?.optics ?? "mirage";
    const size = this.exposures[optics].shown;
    if (size === null) {
      return;
    }
    const from = pixelAt(this.pointer?.place ?? { x: 0.5, y: 0.5 }, size);
    const place = {
      x: (Math.min(Math.max(from.x + x, 0), size.width - 1) + 0.5) / size.width,
      y: (Math.min(Math.max(from.y + y, 0), size.height - 1) + 0.5) / size.height,
    };
    this.pointer = { place, optics: this.side(place), hit: "" };
    this.dwelt.start();
    this.refresh();
  }

  private async reveal(at: Point | null, whole: boolean): Promise<void> {
    const found = at === null ? this.pointer : this.find(at);
    if (found === null) {
      return;
    }
    try {
      const hit = await this.pick(found.optics, found.place);
      if (hit !== null) {
        this.host.reveal(hit, whole);
      }
    } catch {
      // There is nothing to go to; what is wrong is said where the pointer rests.
    }
  }

  /** Asks what the pixel pointed at shows. */
  private async ask(): Promise<void> {
    const { pointer } = this;
    const asked = ++this.asked;
    if (pointer === null || this.obstacle !== null) {
      return;
    }
    let text: string;
    try {
      text = hitText(await this.pick(pointer.optics, pointer.place));
    } catch (fault) {
      text = unknownText(fault instanceof Error ? fault.message : String(fault));
    }
    if (asked === this.asked && this.pointer === pointer) {
      pointer.hit = text;
      this.refresh();
    }
  }

  /** What is at a place; null: nothing. Throws if it cannot be asked. */
  private async pick(optics: Optics, place: Point): Promise<Hit | null> {
    const { shown, answer } = this.exposures[optics];
    if (shown === null || answer === null) {
      throw new Error("the first picture is still being made");
    }
    return this.host.pick(optics, pixelAt(place, shown));
  }

  private askMasks(): void {
    for (const { optics } of this.shown()) {
      void this.askMask(optics);
    }
  }

  private async askMask(optics: Optics): Promise<void> {
    const asked = ++this.masksAsked[optics];
    let mask: Mask | null = null;
    try {
      mask = this.exposures[optics].answer === null ? null : await this.host.mask(optics);
    } catch {
      // The picture has gone meanwhile.
    }
    if (asked === this.masksAsked[optics]) {
      this.masks[optics] = mask;
      this.refresh();
    }
  }

  // --- rendering -----------------------------------------------------------------------------------------------

  private shown(): Exposure[] {
    const { show } = this.options_;
    return show === "both" ? [this.exposures.mirage, this.exposures.straight] : [this.exposures[show]];
  }

  private render(quality: Quality, exposures = this.shown()): void {
    this.calm.picture.stop();
    this.rested.stop();
    this.missed = !this.isVisible;
    if (this.scene_ === null || !this.isVisible || this.obstacle !== null) {
      return;
    }
    for (const exposure of exposures) {
      exposure.request(quality, this.limits(exposure, quality));
    }
    if (quality === "draft") {
      this.rested.start();
    }
  }

  private limits(exposure: Exposure, quality: Quality): Limits {
    const { resolution, typingResolution, render } = this.options_;
    const pane = {
      width: Math.max(Math.round(this.view.pane.clientWidth * devicePixelRatio), 16),
      height: Math.max(Math.round(this.view.pane.clientHeight * devicePixelRatio), 16),
    };
    if (quality === "draft") {
      const { width, height } = exposure.full ?? pane;
      return {
        maxWidth: Math.max(Math.round(width * typingResolution), 16),
        maxHeight: Math.max(Math.round(height * typingResolution), 16),
        ...(resolution === "pane" && { fill: true }),
        ...RENDER_OPTIONS,
      };
    }
    const size = resolution === "scene" ? {} : { maxWidth: pane.width, maxHeight: pane.height, fill: true };
    return { ...size, ...render };
  }

  /** The pane has another size. */
  private resize(): void {
    const { clientWidth, clientHeight } = this.view.pane;
    this.viewport.setPane(clientWidth, clientHeight);
    this.stage.resize(clientWidth, clientHeight, devicePixelRatio);
    this.catchUp();
    this.refresh(true);
  }

  /** The pane may have grown, be it while a picture was on its way: then a larger one is made. */
  private catchUp(): void {
    const grown = this.shown().some(({ full }) => full?.limited === true && this.isSmaller(full));
    if (grown && this.options_.resolution === "pane") {
      this.rested.start();
    }
  }

  /** Whether a picture is notably smaller than the pane. */
  private isSmaller(full: { width: number; height: number }): boolean {
    const { clientWidth, clientHeight } = this.view.pane;
    return Math.min(clientWidth / full.width, clientHeight / full.height) * devicePixelRatio > 1.02;
  }

  // --- showing -------------------------------------------------------------------------------------------------

  /** The place in the picture at a point of the pane, and which picture is there. */
  private find(at: Point): { place: Point; optics: Optics } | null {
    const place = this.viewport.fraction(at);
    const optics = this.side(place);
    return isInside(place) && this.exposures[optics].shown !== null ? { place, optics } : null;
  }

  /** Which picture is shown at a place. */
  private side(place: Point): Optics {
    const { show } = this.options_;
    return show !== "both" ? show : place.x < this.divider ? "mirage" : "straight";
  }

  /** Draws before the next frame, once for however many changes. */
  private refresh(atOnce = false): void {
    if (atOnce) {
      this.draw();
    } else {
      this.drawn ||= requestAnimationFrame(() => this.draw());
    }
  }

  private draw(): void {
    this.drawn = 0;
    const shown = this.shown();
    const { mirage, straight } = this.exposures;
    const full = shown.find((exposure) => exposure.full !== null)?.full ?? shown[0]?.shown;
    if (full) {
      this.viewport.setPicture(full.width, full.height * ("aspect" in full ? full.aspect : 1));
    }
    for (const { optics, shown: bitmap } of shown) {
      if (!this.fresh[optics]) {
        this.stage.update(optics, bitmap);
        this.fresh[optics] = true;
      }
    }
    const { pointer } = this;
    const under = pointer === null ? null : this.exposures[pointer.optics].shown;
    const pixel = pointer === null || under === null ? null : pixelAt(pointer.place, under);
    this.stage.draw({
      show: this.options_.show,
      divider: this.divider,
      layers: {
        mirage: { bitmap: mirage.shown, mask: this.masks.mirage },
        straight: { bitmap: straight.shown, mask: this.masks.straight },
      },
      pixel,
    });
    const { frame } = this.viewport;
    this.view.setDivider(this.divider, frame.x + this.divider * frame.width);
    this.view.setZoom(full ? this.viewport.scale * devicePixelRatio : null);
    this.view.setName(this.scene_?.name ?? "no scene", full ? `, ${full.width} by ${full.height} pixels` : "");
    this.showState(shown);
    if (pointer === null || under === null || pixel === null) {
      this.view.setReadout(this.summary(shown), null, "");
    } else {
      const color = under.color(pixel.x, pixel.y);
      const text = pixelText(pixel, color, pointer.optics);
      this.view.setReadout(text, color === null ? null : css(color), pointer.hit);
    }
  }

  private showState(shown: Exposure[]): void {
    const answers = shown.map(({ answer }) => answer);
    const rendering = shown.some((exposure) => exposure.rendering);
    const version = this.scene_?.version ?? 0;
    const progress = Math.min(...shown.map((exposure) => exposure.progress));
    const state = badge({
      blocked: this.obstacle?.reason ?? null,
      error: shown.find(({ error }) => error !== null)?.error ?? null,
      rendering,
      progress,
      stale: this.scene_?.errors === true || answers.some((answer) => answer?.stale === true),
      problem: this.scene_?.problem ?? null,
      outdated: answers.some((answer) => answer !== null && answer.version < version),
      any: shown.some((exposure) => exposure.shown !== null),
    });
    this.view.setBadge(state, progress);
  }

  /** What is shown, while no pixel is pointed at. */
  private summary(shown: Exposure[]): string {
    const whole = this.options_.resolution === "scene";
    const parts = shown.flatMap(({ answer, optics }) => (answer === null ? [] : pictureText(optics, answer, whole)));
    const flat = this.exposures.mirage.answer?.bent === false;
    return parts.join("   ") + (flat ? "   no MIRAGE in the scene: both are the same" : "");
  }
}
