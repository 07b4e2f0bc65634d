/** The whole picture part in a page, with a host that a test speaks for. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";

import type { Hit, Scene } from "../src/host";
import { Preview } from "../src/preview";
import { FakeHost, plain, settled } from "./fake-host";

const SCENE: Scene = { id: "file:///a.m3d", name: "a.m3d", version: 1, render: true, errors: false, problem: null };
const HIT = { line: 7, position: [0, 0, 0], depth: 1, path: { length: 1, arcs: 1 } } as unknown as Hit;

let host: FakeHost;
let root: HTMLElement;

/** A canvas context that draws nothing; this page's canvas has none. */
const context = new Proxy({}, { get: () => () => undefined, set: () => true });

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("ImageData", Object);
  vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(context as never);
  for (const [name, size] of [
    ["clientWidth", 200],
    ["clientHeight", 100],
  ] as const) {
    vi.spyOn(HTMLElement.prototype, name, "get").mockReturnValue(size);
  }
  host = new FakeHost();
  root = document.createElement("div");
  document.body.replaceChildren(root);
  new Preview(root, host);
});

afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

function scene(changes: Partial<Scene> = {}): void {
  host.events?.scene({ ...SCENE, ...changes });
}

/** Draws what has changed. */
async function drawn(): Promise<void> {
  await settled();
  vi.advanceTimersByTime(50);
  await settled();
}

/** Lets the keys rest for a moment. */
function calm(): void {
  vi.advanceTimersByTime(60);
}

async function rendered(version = 1, red = 10): Promise<void> {
  const { length } = host.asked;
  host.asked[length - 1]?.tile(plain(red));
  await host.asked[length - 1]?.answer({ version });
  await drawn();
}

function press(key: string, shiftKey = false): void {
  root.querySelector("canvas")?.dispatchEvent(new KeyboardEvent("keydown", { key, shiftKey, cancelable: true }));
}

function text(selector: string): string {
  return root.querySelector(selector)?.textContent ?? "";
}

function click(label: string): void {
  root.querySelector<HTMLElement>(`button[aria-label="${label}"]`)?.click();
}

test("the first picture is a full one, as large as the pane, in the pixels of the screen", () => {
  vi.stubGlobal("devicePixelRatio", 1.5);
  scene();
  expect(host.asked.map(({ request }) => request)).toEqual([
    { optics: "mirage", maxWidth: 300, maxHeight: 150, fill: true, samples: 1 },
  ]);
});

test("the scene's own size is rendered on wish, shown in the shape that its ASPECT gives it", async () => {
  scene();
  root.querySelector<HTMLElement>(".m3d-whole input")?.click();
  expect(host.asked[1]?.request).toEqual({ optics: "mirage", samples: 1 });
  await host.asked[1]?.answer({ width: 320, height: 200, aspect: 1.2, ownWidth: 320, ownHeight: 200 });
  await drawn();
  // 320 by 240 in a pane of 200 by 100.
  expect(text(".m3d-zoom")).toBe("42 %");
  expect(text(".m3d-pixel")).toBe("mirage 320 × 200 in 1.00 s");
});

test("a picture that could not have the scene's own size says so", async () => {
  scene();
  root.querySelector<HTMLElement>(".m3d-whole input")?.click();
  await host.asked[1]?.answer({ width: 2000, height: 2000, ownWidth: 4000, ownHeight: 4000 });
  await drawn();
  expect(text(".m3d-pixel")).toContain("mirage 2000 × 2000 (of 4000 × 4000, too many for a preview");
});

test("a scene whose full picture is made fast needs no small ones", async () => {
  scene();
  await host.asked[0]?.answer({ width: 200, height: 100, seconds: 0.1 });
  for (let version = 2; version < 4; version++) {
    scene({ version });
    calm();
    expect(host.asked[version - 1]?.request.maxWidth).toBe(200);
    await host.asked[version - 1]?.answer({ version, width: 200, height: 100, seconds: 0.1 });
  }
  vi.advanceTimersByTime(1000);
  expect(host.asked.length).toBe(3);
});

test("once full pictures are overtaken by the keys there are small ones again", async () => {
  scene();
  await host.asked[0]?.answer({ width: 200, height: 100, seconds: 0.1 });
  scene({ version: 2 });
  calm();
  scene({ version: 3 });
  calm();
  expect(host.asked[2]?.request.maxWidth).toBe(200);
  scene({ version: 4 });
  calm();
  expect(host.asked[3]?.request.maxWidth).toBe(100);
});

test("while one types there are small pictures, and a full one when the text has rested", async () => {
  scene();
  await host.asked[0]?.answer({ width: 200, height: 100 });
  scene({ version: 2 });
  calm();
  expect(host.asked[1]?.request).toEqual({ optics: "mirage", maxWidth: 100, maxHeight: 50, fill: true, samples: 1 });
  await host.asked[1]?.answer({ version: 2 });
  scene({ version: 3 });
  calm();
  await host.asked[2]?.answer({ version: 3 });
  vi.advanceTimersByTime(399);
  expect(host.asked.length).toBe(3);
  vi.advanceTimersByTime(1);
  expect(host.asked[3]?.request.maxWidth).toBe(200);
});

test("what is typed in error puts the full picture off, too", async () => {
  scene();
  await rendered();
  scene({ version: 2 });
  calm();
  await rendered(2);
  vi.advanceTimersByTime(300);
  scene({ version: 3, errors: true });
  vi.advanceTimersByTime(399);
  expect(host.asked.length).toBe(2);
  vi.advanceTimersByTime(1);
  expect(host.asked[2]?.request.maxWidth).toBe(200);
});

test("nothing is rendered for a text with errors, and the picture says that it is stale", async () => {
  scene();
  await rendered();
  scene({ version: 2, errors: true });
  await drawn();
  expect(host.asked.length).toBe(1);
  expect(text(".m3d-badge")).toBe("Stale");
  scene({ version: 3 });
  calm();
  await drawn();
  expect(host.asked.length).toBe(2);
});

test("between keys in quick succession nothing is rendered", async () => {
  scene();
  await rendered();
  for (let version = 2; version < 6; version++) {
    scene({ version });
    vi.advanceTimersByTime(59);
  }
  expect(host.asked.length).toBe(1);
  calm();
  expect(host.asked.length).toBe(2);
});

test("what was right before an error is shown once the text has rested", async () => {
  scene();
  await rendered();
  scene({ version: 2 });
  scene({ version: 3, errors: true });
  vi.advanceTimersByTime(399);
  expect(host.asked.length).toBe(1);
  vi.advanceTimersByTime(1);
  expect(host.asked[1]?.request.maxWidth).toBe(200);
});

test("a text that waits to be saved makes the picture stale", async () => {
  scene();
  await rendered();
  expect(text(".m3d-badge")).toBe("");
  scene({ version: 2, render: false });
  await drawn();
  expect([text(".m3d-badge"), host.asked.length]).toEqual(["Stale", 1]);
});

test("an error is said on the picture, which stays", async () => {
  scene();
  await rendered();
  host.events?.again();
  await host.asked[1]?.answer({ status: "error", message: "no memory" });
  await drawn();
  expect(text(".m3d-badge")).toBe("Error, last good picture: no memory");
  root.querySelector<HTMLElement>(".m3d-badge")?.click();
  expect(host.calls).toContainEqual(["showOutput"]);
});

test("before the first tile nothing is done yet", async () => {
  scene();
  await rendered();
  host.events?.again();
  await drawn();
  expect(text(".m3d-badge")).toBe("Rendering 0 %");
});

test("a click on what is stale leads to the first error", async () => {
  scene();
  await rendered();
  scene({ version: 2, errors: true, problem: "line 12: Invalid SUN statement" });
  await drawn();
  expect(text(".m3d-badge")).toBe("Stale: line 12: Invalid SUN statement");
  root.querySelector<HTMLElement>(".m3d-badge")?.click();
  expect(host.calls).toContainEqual(["showProblem"]);
});

test("a click on a picture that waits to be saved makes it anew", async () => {
  scene();
  await rendered();
  scene({ version: 2, render: false });
  await drawn();
  root.querySelector<HTMLElement>(".m3d-badge")?.click();
  expect(host.asked.length).toBe(2);
});

test("where it cannot be known what a pixel shows, it is not said that it shows nothing", async () => {
  scene();
  await rendered();
  host.pickFails = "the language server does not run";
  press("ArrowLeft");
  vi.advanceTimersByTime(120);
  await drawn();
  expect(text(".m3d-hit")).toBe("what is here is not known: the language server does not run");
  press("Enter");
  await settled();
  expect(host.calls.some(([name]) => name === "reveal")).toBe(false);
});

test("nothing is rendered while nobody sees it", () => {
  host.events?.visible(false);
  scene();
  expect(host.asked.length).toBe(0);
  host.events?.visible(true);
  expect(host.asked.length).toBe(1);
  host.events?.visible(false);
  host.events?.visible(true);
  expect(host.asked.length).toBe(1);
});

test("while there can be no picture it says why, once, and what to do about it", async () => {
  host.events?.blocked({ reason: "Nothing is rendered in Restricted Mode.", actions: ["Manage Workspace Trust"] });
  scene();
  await drawn();
  expect(host.asked.length).toBe(0);
  expect(text(".m3d-blocked p")).toBe("Nothing is rendered in Restricted Mode.");
  expect(root.querySelector<HTMLElement>(".m3d-badge")?.hidden).toBe(true);
  click("Manage Workspace Trust");
  expect(host.calls).toContainEqual(["carryOut", "Manage Workspace Trust"]);
  host.events?.blocked(null);
  expect(host.asked.length).toBe(1);
});

test("both kinds of light are rendered for the slider, which arrow keys move", async () => {
  scene();
  await rendered();
  click("Both");
  await drawn();
  expect(host.asked.slice(1).map(({ request }) => request.optics)).toEqual(["straight"]);
  const slider = root.querySelector<HTMLElement>("[role=slider]");
  expect([slider?.hidden, slider?.getAttribute("aria-valuenow")]).toEqual([false, "50"]);
  const sides = [...root.querySelectorAll<HTMLElement>(".m3d-side")];
  expect(sides.map(({ textContent, hidden }) => [textContent, hidden])).toEqual([
    ["mirage", false],
    ["straight", false],
  ]);
  slider?.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
  await drawn();
  expect(slider?.getAttribute("aria-valuenow")).toBe("52");
});

test("keys move from pixel to pixel, say what is there and lead to its text", async () => {
  host.hit = HIT;
  scene();
  await rendered();
  press("ArrowLeft");
  await drawn();
  expect(text(".m3d-pixel")).toBe("x 0  y 1   0.039  0.000  0.000   mirage");
  vi.advanceTimersByTime(120);
  await drawn();
  expect(text(".m3d-hit")).toContain("line 7");
  press("Enter");
  await settled();
  press("Enter", true);
  await settled();
  expect(host.calls.filter(([name]) => name === "reveal")).toEqual([
    ["reveal", 7, false],
    ["reveal", 7, true],
  ]);
});

test("a click leads to the text of what is there, and nowhere where nothing is", async () => {
  scene();
  await rendered();
  const canvas = root.querySelector("canvas");
  canvas?.dispatchEvent(new PointerEvent("pointermove", { clientX: 120, clientY: 20 }));
  press("Enter");
  await settled();
  expect(host.calls).toContainEqual(["pick", "mirage", 1, 0, "of 2 x 2"]);
  expect(host.calls.some(([name]) => name === "reveal")).toBe(false);
});

test("the pointer stays where it is as pictures of other sizes come, and what is there is asked for anew", async () => {
  scene();
  await rendered();
  root.querySelector("canvas")?.dispatchEvent(new PointerEvent("pointermove", { clientX: 120, clientY: 20 }));
  vi.advanceTimersByTime(120);
  await drawn();
  expect(text(".m3d-pixel")).toContain("x 1  y 0 ");
  scene({ version: 2 });
  calm();
  const fine = host.asked[host.asked.length - 1];
  fine?.tile({ ...plain(0, 20), width: 20, height: 20 });
  await drawn();
  expect(text(".m3d-pixel")).toContain("x 14  y 4 ");
  await fine?.answer({ version: 2, width: 20, height: 20 });
  expect(host.calls.filter(([name]) => name === "pick")).toEqual([
    ["pick", "mirage", 1, 0, "of 2 x 2"],
    ["pick", "mirage", 14, 4, "of 20 x 20"],
  ]);
});

test("what the cursor is in is asked for again with each new picture", async () => {
  scene();
  await rendered();
  expect(host.calls).toEqual([["mask", "mirage"]]);
  host.events?.cursor();
  calm();
  expect(host.calls.length).toBe(2);
});

test("everything has a name, and can be reached with the keyboard", () => {
  const reached = [...root.querySelectorAll<HTMLElement>("button, input, canvas, [tabindex]")];
  expect(reached.length).toBeGreaterThan(10);
  for (const element of reached) {
    const label = element.getAttribute("aria-label") ?? element.closest("label")?.textContent ?? "";
    if (!element.classList.contains("m3d-badge")) {
      expect(label, element.outerHTML).not.toBe("");
    }
  }
});

test("the second stop of the Tab key is the picture; the arrow keys go along the toolbar", () => {
  const all = [...root.querySelectorAll<HTMLElement>("button, input, canvas")];
  const stops = all.filter(({ tabIndex }) => tabIndex === 0);
  expect(stops.map((stop) => stop.getAttribute("aria-label")?.slice(0, 7)).slice(0, 2)).toEqual(["Mirage", "Picture"]);
  const reached: string[] = [];
  stops[0]?.focus();
  for (let count = 0; count < 10; count++) {
    reached.push(document.activeElement?.getAttribute("aria-label") ?? "own size");
    document.activeElement?.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
  }
  expect(reached).toEqual([
    "Mirage",
    "Straight",
    "Both",
    "Smaller",
    "Larger",
    "Fit",
    "Actual size",
    "own size",
    "Save",
    "Pin",
  ]);
  expect((document.activeElement as HTMLElement).getAttribute("aria-label")).toBe("Mirage");
});

test("buttons do what they say", async () => {
  scene();
  await rendered();
  click("Save");
  click("Pin");
  host.events?.options({ pinned: true });
  expect(root.querySelector("button[aria-label=Pin]")?.getAttribute("aria-pressed")).toBe("true");
  click("Pin");
  expect(host.calls.slice(1)).toEqual([
    ["save", "mirage"],
    ["pin", true],
    ["pin", false],
  ]);
});

test("zooming is said in percent", async () => {
  scene();
  await rendered();
  expect(text(".m3d-zoom")).toBe("5000 %");
  press("1");
  await drawn();
  expect(text(".m3d-zoom")).toBe("100 %");
  press("0");
  await drawn();
  expect(text(".m3d-zoom")).toBe("5000 %");
});

test("what is chosen in it is told, what is set from outside is not", () => {
  scene();
  host.calls.length = 0;
  click("Straight");
  const full = root.querySelector<HTMLElement>(".m3d-whole input");
  full?.click();
  full?.click();
  host.events?.options({ show: "both", resolution: "scene" });
  expect(host.calls.filter(([name]) => name === "chose")).toEqual([
    ["chose", { show: "straight" }],
    ["chose", { resolution: "scene" }],
    ["chose", { resolution: "pane" }],
  ]);
});

test("a pane that grew while its picture was on its way gets a larger one", async () => {
  const width = vi.spyOn(HTMLElement.prototype, "clientWidth", "get").mockReturnValue(20);
  scene();
  width.mockReturnValue(200);
  await host.asked[0]?.answer({ width: 20, height: 10 });
  vi.advanceTimersByTime(400);
  await host.asked[1]?.answer({ width: 160, height: 100 });
  vi.advanceTimersByTime(400);
  expect(host.asked.map(({ request }) => request.maxWidth)).toEqual([20, 200]);
});
