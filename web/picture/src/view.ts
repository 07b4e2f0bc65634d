/** The elements of a preview: toolbar, pane and read-out, with their labels for people and for screen readers. */

import type { Obstacle, Show } from "./host";
import type { Badge } from "./state";

export interface Actions {
  show(show: Show): void;
  fit(): void;
  actual(): void;
  zoom(factor: number): void;
  wholeSize(on: boolean): void;
  save(): void;
  pin(pinned: boolean): void;
  divide(part: number): void;
  /** Something that an obstacle offers. */
  carryOut(action: string): void;
  /** To where the badge leads. */
  lead(to: NonNullable<Badge["leads"]>): void;
}

const HELP =
  "Arrow keys move from pixel to pixel, Enter shows where the thing is written, Shift+Enter its whole solid. " +
  "Plus, minus, 0 and 1 zoom, Shift with arrow keys moves the picture. M, S and B choose mirage, straight or both.";

const NAMES: Record<Show, string> = { mirage: "Mirage", straight: "Straight", both: "Both" };

const SHOW_HELP: Record<Show, string> = {
  mirage: "Light bent by the air (M)",
  straight: "Light that travels straight (S)",
  both: "Both, under a slider (B)",
};

/** One step of the divider's arrow keys, as a part of the picture. */
const STEP = 0.02;

export class View {
  readonly canvas = element("canvas", "m3d-canvas");
  readonly pane = element("div", "m3d-pane");
  private readonly divider = element("div", "m3d-divider");
  private readonly sides = { mirage: element("span", "m3d-side"), straight: element("span", "m3d-side") };
  private readonly badge = element("button", "m3d-badge");
  private readonly bar = element("div", "m3d-bar");
  private readonly blocked = element("div", "m3d-blocked");
  private readonly zoom = element("output", "m3d-zoom");
  private readonly swatch = element("span", "m3d-swatch");
  private readonly pixel = element("span", "m3d-pixel");
  private readonly hit = element("span", "m3d-hit");
  private readonly shows = new Map<Show, HTMLButtonElement>();
  private readonly pin: HTMLButtonElement;
  private readonly whole = element("input", "");
  private leads: Badge["leads"] = null;

  constructor(
    root: HTMLElement,
    private readonly actions: Actions,
  ) {
    root.classList.add("m3d-preview");
    const toolbar = element("div", "m3d-toolbar");
    toolbar.setAttribute("role", "toolbar");
    toolbar.setAttribute("aria-label", "Picture");
    const group = element("div", "m3d-group");
    group.setAttribute("role", "group");
    group.setAttribute("aria-label", "Light");
    for (const show of ["mirage", "straight", "both"] as const) {
      const choice = button(NAMES[show], SHOW_HELP[show], () => actions.show(show));
      this.shows.set(show, choice);
      group.append(choice);
    }
    const zoom = element("div", "m3d-group");
    zoom.setAttribute("role", "group");
    zoom.setAttribute("aria-label", "Size");
    this.zoom.setAttribute("aria-label", "Zoom");
    zoom.append(
      button("−", "Smaller (-)", () => actions.zoom(1 / 1.5), "Smaller"),
      this.zoom,
      button("+", "Larger (+)", () => actions.zoom(1.5), "Larger"),
      button("Fit", "Fit the picture into the pane (0)", () => actions.fit()),
      button("1:1", "A pixel of the screen for each of the picture (1)", () => actions.actual(), "Actual size"),
    );
    this.whole.type = "checkbox";
    this.whole.addEventListener("change", () => actions.wholeSize(this.whole.checked));
    const label = element("label", "m3d-whole");
    label.title = "Render WIDTH x HEIGHT pixels, however large the pane is";
    label.append(this.whole, "Own size");
    const files = element("div", "m3d-group m3d-right");
    this.pin = button("Pin", "Keep this scene while others are edited", () =>
      actions.pin(this.pin.getAttribute("aria-pressed") !== "true"),
    );
    files.append(
      button("Save", "Save the picture as PNG, EXR or TIFF", () => actions.save()),
      this.pin,
    );
    toolbar.append(group, zoom, label, files);
    oneStop(toolbar);

    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-roledescription", "picture");
    this.canvas.setAttribute("aria-describedby", "m3d-help");
    this.badge.type = "button";
    this.badge.addEventListener("click", () => this.leads !== null && actions.lead(this.leads));
    const told = element("div", "");
    told.setAttribute("role", "status");
    told.append(this.badge);
    this.blocked.hidden = true;
    this.blocked.setAttribute("role", "alert");
    for (const [name, side] of Object.entries(this.sides)) {
      side.textContent = name;
      side.setAttribute("aria-hidden", "true");
    }
    this.bar.setAttribute("aria-hidden", "true");
    this.setUpDivider(actions);
    this.pane.append(this.canvas, ...Object.values(this.sides), this.divider, told, this.bar, this.blocked);

    const readout = element("div", "m3d-readout");
    readout.setAttribute("role", "status");
    readout.append(this.swatch, this.pixel, this.hit);
    const help = element("p", "m3d-hidden");
    help.id = "m3d-help";
    help.textContent = HELP;
    root.replaceChildren(toolbar, this.pane, readout, help);
    this.setReadout("", null, "");
  }

  setShow(show: Show): void {
    for (const [name, choice] of this.shows) {
      choice.setAttribute("aria-pressed", String(name === show));
    }
    for (const shown of [this.divider, ...Object.values(this.sides)]) {
      shown.hidden = show !== "both";
    }
  }

  setPinned(pinned: boolean): void {
    this.pin.setAttribute("aria-pressed", String(pinned));
  }

  setWholeSize(on: boolean): void {
    this.whole.checked = on;
  }

  setZoom(scale: number | null): void {
    this.zoom.textContent = scale === null ? "–" : `${Math.round(scale * 100)} %`;
  }

  setName(name: string, size: string): void {
    this.canvas.setAttribute("aria-label", `Picture of ${name}${size}`);
  }

  /** Moves the divider; `left` in pixels of the pane. */
  setDivider(part: number, left: number): void {
    this.divider.style.left = `${left}px`;
    this.sides.mirage.style.right = `calc(100% - ${left}px)`;
    this.sides.straight.style.left = `${left}px`;
    this.divider.setAttribute("aria-valuenow", String(Math.round(part * 100)));
  }

  /** Says why there can be no picture, over the one that there may be, with buttons for what can be done about it. */
  setObstacle(obstacle: Obstacle | null): void {
    this.blocked.hidden = obstacle === null;
    const reason = element("p", "");
    reason.textContent = obstacle?.reason ?? "";
    const buttons = (obstacle?.actions ?? []).map((action) =>
      button(action, action, () => this.actions.carryOut(action)),
    );
    this.blocked.replaceChildren(reason, ...buttons);
  }

  setBadge(badge: Badge, progress: number): void {
    this.pane.dataset.state = badge.kind;
    this.badge.hidden = badge.text === "";
    this.badge.dataset.kind = badge.kind;
    // Not at every percent: screen readers would read each.
    if (this.badge.textContent !== badge.text) {
      this.badge.textContent = badge.text;
    }
    this.leads = badge.leads;
    this.badge.disabled = badge.leads === null;
    this.badge.title = badge.detail;
    this.badge.setAttribute("aria-live", badge.kind === "rendering" ? "off" : "polite");
    this.bar.style.width = badge.kind === "rendering" || progress < 1 ? `${100 * progress}%` : "0";
  }

  setReadout(pixel: string, color: string | null, hit: string): void {
    this.swatch.hidden = color === null;
    this.swatch.style.backgroundColor = color ?? "";
    this.pixel.textContent = pixel;
    this.hit.textContent = hit;
    this.hit.title = hit;
  }

  private setUpDivider(actions: Actions): void {
    const { divider } = this;
    divider.tabIndex = 0;
    for (const [name, value] of Object.entries({
      role: "slider",
      "aria-label": "Where mirage and straight meet",
      "aria-orientation": "horizontal",
      "aria-valuemin": "0",
      "aria-valuemax": "100",
    })) {
      divider.setAttribute(name, value);
    }
    divider.title = "Mirage to the left, straight to the right";
    divider.addEventListener("pointerdown", (event) => {
      divider.setPointerCapture(event.pointerId);
      event.preventDefault();
      divider.focus();
    });
    divider.addEventListener("pointermove", (event) => {
      if (divider.hasPointerCapture(event.pointerId)) {
        divider.dispatchEvent(new CustomEvent("m3d-drag", { bubbles: true, detail: event.clientX }));
      }
    });
    divider.addEventListener("keydown", (event) => {
      const now = Number(divider.getAttribute("aria-valuenow")) / 100;
      const to = { ArrowLeft: now - STEP, ArrowRight: now + STEP, Home: 0, End: 1 }[event.key];
      if (to !== undefined) {
        actions.divide(Math.min(Math.max(to, 0), 1));
        event.preventDefault();
        event.stopPropagation();
      }
    });
  }
}

/** Makes a toolbar one stop of the Tab key; within it one goes by arrow keys, Home and End. */
function oneStop(toolbar: HTMLElement): void {
  const stops = [...toolbar.querySelectorAll<HTMLElement>("button, input")];
  const stopAt = (stop: HTMLElement): void => {
    for (const other of stops) {
      other.tabIndex = other === stop ? 0 : -1;
    }
  };
  toolbar.addEventListener("focusin", (event) => stopAt(event.target as HTMLElement));
  toolbar.addEventListener("keydown", (event) => {
    const at = stops.indexOf(event.target as HTMLElement);
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: -1 }[event.key];
    if (to !== undefined && at >= 0) {
      stops.at(to % stops.length)?.focus();
      event.preventDefault();
    }
  });
  stops.slice(1).forEach((stop) => (stop.tabIndex = -1));
}

function element<Name extends keyof HTMLElementTagNameMap>(name: Name, style: string): HTMLElementTagNameMap[Name] {
  const made = document.createElement(name);
  made.className = style;
  return made;
}

function button(text: string, help: string, act: () => void, label = text): HTMLButtonElement {
  const made = element("button", "m3d-button");
  made.type = "button";
  made.textContent = text;
  made.title = help;
  made.setAttribute("aria-label", label);
  made.addEventListener("click", act);
  return made;
}
