/** The workbench of VS Code in a browser, and what a person does in it. */

import * as fs from "node:fs";
import * as path from "node:path";
import { chromium, type Browser, type FrameLocator, type Locator, type Page } from "playwright-core";

import { OUT, type VSCode } from "./vscode";

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
/**
 * How long anything may take, in ms (the variable PATIENCE is in s): on a busy machine much takes long, and nothing is
 * waited for in vain.
 */
const PATIENCE = Number(process.env.PATIENCE ?? 180) * 1000;

const ARGUMENTS = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

export class Workbench {
  private constructor(
    private readonly browser: Browser,
    readonly page: Page,
    private readonly folder: string,
  ) {}

  static async open(vscode: VSCode): Promise<Workbench> {
    const browser = await chromium.launch({ executablePath: CHROMIUM, args: ARGUMENTS });
    const page = await browser.newPage({ viewport: { width: 1440, height: 860 } });
    page.setDefaultTimeout(PATIENCE);
    await page.goto(vscode.url);
    await page.locator(".monaco-workbench .explorer-folders-view").waitFor();
    return new Workbench(browser, page, vscode.folder);
  }

  /** Loads the window anew, as when VS Code is closed and opened again. */
  async reload(): Promise<void> {
    const loaded = this.page.waitForEvent("load");
    await this.command("Developer: Reload Window");
    await loaded;
    await this.page.locator(".monaco-workbench .tabs-container .tab").first().waitFor();
  }

  async close(): Promise<void> {
    await this.browser.close();
  }

  async screenshot(name: string): Promise<void> {
    await this.page.screenshot({ path: path.join(OUT, "screenshots", `${name}.png`) });
  }

  /** Looks again and again until it is so. */
  async eventually(what: string, look: () => Promise<boolean>): Promise<void> {
    const end = Date.now() + PATIENCE;
    while (!(await look())) {
      if (Date.now() > end) {
        throw new Error(`it never came to be that ${what}`);
      }
      await this.page.evaluate(() => new Promise(requestAnimationFrame));
    }
  }

  // --- commands ------------------------------------------------------------------------------------------------

  async command(title: string): Promise<void> {
    await this.page.keyboard.press("F1");
    await this.page.locator(".quick-input-widget .quick-input-box input").fill(`>${title}`);
    await this.page.locator(`.quick-input-list .monaco-list-row[aria-label^="${title}"]`).first().waitFor();
    await this.page.keyboard.press("Enter");
  }

  /** Answers the question at the top of the window. */
  async answer(text: string): Promise<void> {
    const input = this.page.locator(".quick-input-widget:visible .quick-input-box input");
    await input.waitFor();
    await input.fill(text);
    await this.page.keyboard.press("Enter");
  }

  // --- editors -------------------------------------------------------------------------------------------------

  async openScene(name: string): Promise<Locator> {
    if ((await this.page.locator(`.tab[data-resource-name="${name}"]`).count()) > 0) {
      await this.focus(name);
      return this.editor(name);
    }
    const row = this.page.locator(`.explorer-folders-view .monaco-list-row[aria-label*="${name}"]`);
    if ((await row.count()) > 0) {
      await row.dblclick();
    } else {
      // The list of files draws only what there is room for.
      await this.page.keyboard.press("F1");
      await this.page.locator(".quick-input-widget .quick-input-box input").fill(name);
      await this.page.locator(`.quick-input-list .monaco-list-row[aria-label*="${name}"]`).first().waitFor();
      await this.page.keyboard.press("Enter");
    }
    const editor = this.editor(name);
    await editor.waitFor();
    return editor;
  }

  editor(ending: string): Locator {
    return this.page.locator(`.editor-instance .monaco-editor[data-uri*="${ending}"]`);
  }

  /** Puts the keyboard into the editor of an open file, in the first group. */
  async focus(name: string): Promise<void> {
    await this.page.locator(`.tab[data-resource-name="${name}"]`).first().click();
    await this.page.keyboard.press("Control+1");
    const input = this.editor(name).locator(".native-edit-context:focus, textarea:focus").first();
    await input.waitFor({ state: "attached" });
    await this.page.mouse.move(700, 12);
  }

  /** Puts the cursor before the first such text in the scene as it is on disk. */
  async goTo(name: string, text: string): Promise<void> {
    const { line, column } = this.find(name, text);
    await this.focus(name);
    await this.page.keyboard.press("Control+g");
    await this.answer(`:${line}:${column}`);
  }

  find(name: string, text: string): { line: number; column: number } {
    const before = this.read(name).split(text)[0] ?? "";
    const lines = before.split("\n");
    return { line: lines.length, column: (lines[lines.length - 1]?.length ?? 0) + 1 };
  }

  /** The scene on disk. */
  read(name: string): string {
    return fs.readFileSync(path.join(this.folder, name), "utf8");
  }

  /** Saves, and waits until the file has changed if it was dirty. */
  async save(): Promise<void> {
    await this.page.keyboard.press("Control+s");
    await this.page.locator(".tab.active.dirty").waitFor({ state: "detached" });
  }

  /** A word in an editor, by its text as it is drawn. */
  word(name: string, text: string): Locator {
    return this.editor(name).locator(".view-line span span", { hasText: new RegExp(`^\\s*${text}\\s*$`) }).first();
  }

  /** The item in the status bar, once what it says of the server matches. */
  async statusIs(text: string): Promise<void> {
    await this.page.locator(`.statusbar-item[aria-label*="${text}"]`).waitFor();
  }

  /** Runs a scene's text through the keyboard, at the end of an open file. */
  async typeAtEnd(name: string, text: string): Promise<void> {
    await this.focus(name);
    await this.page.keyboard.press("Control+End");
    await this.page.keyboard.type(text);
  }

  // --- the preview ---------------------------------------------------------------------------------------------

  get preview(): FrameLocator {
    return this.page.frameLocator("iframe.webview.ready:visible").frameLocator("iframe#active-frame");
  }

  /** Waits until the picture is whole and that of the text. */
  async pictureIsDone(): Promise<void> {
    // What was just asked for is seen in the next frame; a preview that has no picture yet is in another state.
    await this.preview
      .locator("canvas")
      .evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    await this.preview.locator('.m3d-pane[data-state="current"]').waitFor();
  }

  /** The colours at places of the picture given as parts of its size, red, green, blue, 0 to 255. */
  async colors(places: [number, number][]): Promise<number[][]> {
    return this.preview.locator("canvas").evaluate((element, places) => {
      const canvas = element as HTMLCanvasElement;
      const [width = 1, height = 1] = [...(canvas.ariaLabel ?? "").matchAll(/(\d+) (?:by|pixels)/g)].map((found) =>
        Number(found[1]),
      );
      const scale = Math.min(canvas.width / width, canvas.height / height);
      const left = (canvas.width - width * scale) / 2;
      const top = (canvas.height - height * scale) / 2;
      const context = canvas.getContext("2d");
      return places.map(([x, y]) => [
        ...(context?.getImageData(left + x * width * scale, top + y * height * scale, 1, 1).data.slice(0, 3) ?? []),
      ]);
    }, places);
  }

  /** Waits until the colour at a place is such, written as `red,green,blue`. */
  async colorBecomes(place: [number, number], is: (color: string) => boolean): Promise<void> {
    await this.eventually("the picture has such a colour", async () => is(String((await this.colors([place]))[0])));
  }

  /** Clicks at a place of the picture. */
  async clickPicture([x, y]: [number, number]): Promise<void> {
    const canvas = this.preview.locator("canvas");
    const position = await canvas.evaluate(
      (element, [x, y]) => {
        const canvas = element as HTMLCanvasElement;
        const [width = 1, height = 1] = [...(canvas.ariaLabel ?? "").matchAll(/(\d+) (?:by|pixels)/g)].map((found) =>
          Number(found[1]),
        );
        const scale = Math.min(canvas.clientWidth / width, canvas.clientHeight / height);
        return {
          x: (canvas.clientWidth - width * scale) / 2 + x * width * scale,
          y: (canvas.clientHeight - height * scale) / 2 + y * height * scale,
        };
      },
      [x, y] as const,
    );
    await canvas.click({ position });
  }
}
