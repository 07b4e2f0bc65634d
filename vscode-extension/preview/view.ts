/** The elements of a preview: toolbar, pane and read-out, with their labels for people and for screen readers. */

import type { Show } from "./host";
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
  private readonly badge = element("div", "m3d-badge");
  private readonly bar = element("div", "m3d-bar");
  private readonly blocked = element("p", "m3d-blocked");
  private readonly zoom = element("output", "m3d-zoom");
  private readonly swatch = element("span", "m3d-swatch");
  private readonly pixel = element("span", "m3d-pixel");
  private readonly hit = element("span", "m3d-hit");
  private readonly shows = new Map<Show, HTMLButtonElement>();
  private readonly pin: HTMLButtonElement;
  private readonly whole = element("input", "");

  constructor(root: HTMLElement, actions: Actions) {
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
    label.title = "Render at the scene's own size, however large the pane is";
    label.append(this.whole, "Full");
    const files = element("div", "m3d-group m3d-right");
    this.pin = button("Pin", "Keep this scene while others are edited", () =>
      actions.pin(this.pin.getAttribute("aria-pressed") !== "true"),
    );
    files.append(
      button("Save", "Save the picture as PNG, EXR or TIFF", () => actions.save()),
      this.pin,
    );
    toolbar.append(group, zoom, label, files);

    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-roledescription", "picture");
    this.canvas.setAttribute("aria-describedby", "m3d-help");
    this.badge.setAttribute("role", "status");
    this.blocked.hidden = true;
    this.bar.setAttribute("aria-hidden", "true");
    this.setUpDivider(actions);
    this.pane.append(this.canvas, this.divider, this.badge, this.bar, this.blocked);

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
    this.divider.hidden = show !== "both";
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
    this.divider.setAttribute("aria-valuenow", String(Math.round(part * 100)));
  }

  setBadge(badge: Badge, progress: number): void {
    this.pane.dataset.state = badge.kind;
    this.badge.hidden = badge.text === "";
    this.badge.dataset.kind = badge.kind;
    // Not at every percent: screen readers would read each.
    const text = badge.kind === "error" ? `${badge.text}: ${badge.detail}` : badge.text;
    if (this.badge.textContent !== text) {
      this.badge.textContent = text;
    }
    this.badge.title = badge.detail;
    this.badge.setAttribute("aria-live", badge.kind === "rendering" ? "off" : "polite");
    this.bar.style.width = badge.kind === "rendering" || progress < 1 ? `${100 * progress}%` : "0";
    this.blocked.hidden = badge.kind !== "blocked";
    this.blocked.textContent = badge.kind === "blocked" ? badge.detail : "";
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
