/**
 * A person at work: a scene is opened, mended, renamed, laid out, looked at. One VS Code and one page for all; the
 * steps are carried out in their order.
 */

import assert from "node:assert/strict";
import * as fs from "node:fs";
import * as path from "node:path";
import { after, before } from "node:test";

import type { Locator } from "playwright-core";

import { contrasts } from "./contrast";
import { latencies, median } from "./latency";
import { stepper } from "./step";
import { OUT, startVSCode, type VSCode } from "./vscode";
import { Workbench } from "./workbench";

const SCENE = "merman.m3d";
const BALLS = "two-balls.m3d";

/** Places of the merman's picture, as parts of its size. */
const SKY: [number, number] = [0.1, 0.1];
const PILLAR: [number, number] = [0.289, 0.475];
const WALL: [number, number] = [0.5, 0.47];

const THEMES = [
  { name: "dark", theme: "Default Dark Modern", mark: "vs-dark", icon: "dark" },
  { name: "light", theme: "Default Light Modern", mark: "vs", icon: "light" },
  { name: "high contrast", theme: "Default High Contrast", mark: "hc-black", icon: "dark" },
  { name: "light high contrast", theme: "Default High Contrast Light", mark: "hc-light", icon: "light" },
] as const;

/** How a webview's body is marked in each. */
const THEME_CLASS = {
  "vs-dark": "vscode-dark",
  vs: "vscode-light",
  "hc-black": "vscode-high-contrast",
  "hc-light": "vscode-high-contrast-light",
};

let vscode: VSCode;
let workbench: Workbench;
const measured: Record<string, unknown> = {};
const step = stepper(() => workbench);

before(async () => {
  vscode = await startVSCode("editing", true);
  workbench = await Workbench.open(vscode);
});

after(async () => {
  fs.writeFileSync(path.join(OUT, "workbench.json"), `${JSON.stringify(measured, null, 2)}\n`);
  await workbench.close();
  await vscode.stop();
});

step("a scene opens, coloured, and the server starts", async () => {
  await workbench.openScene(SCENE);
  await workbench.statusIs("Mirage3D: the language server runs");
  const colors = new Set<string>();
  for (const word of ["SCENE", "FROM", "LOGSCALE"]) {
    colors.add(await workbench.word(SCENE, word).evaluate((span) => getComputedStyle(span).color));
  }
  assert.ok(colors.size > 1, "blocks and properties have one colour");
});

step("a squiggle appears as an error is typed, and goes as it is mended", async () => {
  const editor = workbench.editor(SCENE);
  await workbench.goTo(SCENE, "ZENITH 20");
  await workbench.page.keyboard.press("Delete");
  await editor.locator(".squiggly-error").first().waitFor();
  await workbench.page.keyboard.press("Control+Shift+m");
  await workbench.page.locator('.markers-panel .monaco-list-row[aria-label*="ENITH"]').first().waitFor();
  await workbench.screenshot("problem");
  await workbench.page.keyboard.press("Control+Shift+m");
  await workbench.focus(SCENE);
  await workbench.page.keyboard.press("Control+z");
  await editor.locator(".squiggly-error").first().waitFor({ state: "detached" });
});

step("a keyword tells what it means", async () => {
  await workbench.goTo(SCENE, "LOGSCALE");
  await workbench.word(SCENE, "LOGSCALE").hover();
  const hover = workbench.page.locator(".monaco-hover:not(.hidden)").first();
  await hover.getByText("Brightens the dark parts").waitFor();
  await workbench.screenshot("hover");
  await workbench.page.keyboard.press("Escape");
});

step("a statement is completed", async () => {
  await workbench.goTo(SCENE, "LOGSCALE 15");
  await workbench.page.keyboard.type("SHAD");
  // As a person would, who sees what is typed: VS Code drops what is asked for while keys are still pending.
  await workbench.word(SCENE, "SHADLOGSCALE").waitFor();
  await workbench.page.keyboard.press("Control+Space");
  const row = workbench.page.locator('.suggest-widget.visible .monaco-list-row[aria-label^="SHADOWS"]').first();
  await row.waitFor();
  await workbench.screenshot("completion");
  await row.click();
  await workbench.page.keyboard.press("Enter");
  await workbench.save();
  assert.match(workbench.read(SCENE), /SHADOWS\s+LOGSCALE 15/);
  assert.equal(await workbench.editor(SCENE).locator(".squiggly-error").count(), 0);
});

step("a variable is renamed wherever it stands", async () => {
  await workbench.openScene(BALLS);
  const before = workbench.read(BALLS).match(/\bbronze\b/g)?.length ?? 0;
  assert.ok(before > 2);
  await workbench.goTo(BALLS, "bronze =");
  await workbench.page.keyboard.press("F2");
  const box = workbench.page.locator(".rename-box input");
  await box.waitFor();
  await box.fill("copper");
  await workbench.page.keyboard.press("Enter");
  await box.waitFor({ state: "hidden" });
  await workbench.page.locator(".tab.active.dirty").waitFor();
  await workbench.save();
  const text = workbench.read(BALLS);
  const comments = text.match(/\/\*.*?\*\//gs)?.join("").match(/\bbronze\b/g)?.length ?? 0;
  assert.equal(text.match(/\bcopper\b/g)?.length, before - comments);
});

step("a scene is laid out", async () => {
  await workbench.openScene(BALLS);
  await workbench.goTo(BALLS, "ball = {");
  await workbench.page.keyboard.type("      ");
  await workbench.command("Mirage3D: Format Scene");
  const lines = workbench.editor(BALLS).locator(".view-line");
  await workbench.eventually("the line begins at the margin", async () =>
    (await lines.allTextContents()).some((line) => /^ball\s=/.test(line)),
  );
  await workbench.save();
  assert.match(workbench.read(BALLS), /^ball = \{ CENTER < -2, 0, 1 > \}$/m);
});

step("a colour is picked", async () => {
  await workbench.openScene(BALLS);
  await workbench.goTo(BALLS, "yellow = <");
  const line = workbench.find(BALLS, "yellow = <").line;
  await workbench.editor(BALLS).locator(".colorpicker-color-decoration").first().waitFor();
  const row = workbench.editor(BALLS).locator(".view-line", { hasText: /yellow\s=/ });
  await row.locator(".colorpicker-color-decoration").first().click();
  const box = workbench.page.locator(".colorpicker-widget .saturation-box").first();
  await box.waitFor();
  await workbench.screenshot("colour");
  const before = workbench.read(BALLS);
  await box.click({ position: { x: 60, y: 30 } });
  await workbench.page.locator(".tab.active.dirty").waitFor();
  await workbench.page.keyboard.press("Escape");
  await workbench.save();
  const [was, is] = [before, workbench.read(BALLS)].map((text) => text.split("\n"));
  const changed = is?.map((text, index) => (text === was?.[index] ? 0 : index + 1)).filter((number) => number > 0);
  assert.deepEqual(changed, [line]);
  assert.match(is?.[line - 1] ?? "", /^yellow = < [\d.]+, [\d.]+, [\d.]+ >$/);
});

step("the time from a key to its diagnostic, without a preview", async () => {
  await workbench.openScene(SCENE);
  measured.keyToDiagnosticsClosed = await latencies(workbench, SCENE);
});

step("the preview shows the mirage, and straight light something else where it should", async () => {
  await workbench.goTo(SCENE, "SOLID /* lower left");
  await workbench.command("Mirage3D: Open Preview to the Side");
  await workbench.pictureIsDone();
  const [sky, pillar, wall] = await workbench.colors([SKY, PILLAR, WALL]);
  await workbench.preview.getByRole("button", { name: "Straight" }).click();
  await workbench.preview.getByText(/^straight \d+/).waitFor();
  await workbench.pictureIsDone();
  await workbench.screenshot("straight");
  const [straightSky, straightPillar, straightWall] = await workbench.colors([SKY, PILLAR, WALL]);
  const [red = 0, green = 0, blue = 0] = pillar ?? [];
  assert.ok(blue > 100 && red < 60 && green < 60, `the pillar is blue: ${String(pillar)}`);
  assert.deepEqual(sky, straightSky);
  assert.notDeepEqual(wall, straightWall, "the wall does not reach so high without a mirage");
  assert.notDeepEqual(pillar, straightPillar);
  await workbench.preview.getByRole("button", { name: "Mirage" }).click();
  await workbench.preview.getByText(/^mirage \d+/).waitFor();
  await workbench.pictureIsDone();
  assert.deepEqual(await workbench.colors([SKY, PILLAR, WALL]), [sky, pillar, wall]);
  await workbench.screenshot("preview");
});

step("the time from a key to its diagnostic, with the preview", async () => {
  const open = await latencies(workbench, SCENE);
  measured.keyToDiagnosticsOpen = open;
  const closed = measured.keyToDiagnosticsClosed as number[];
  measured.ratio = median(open) / median(closed);
  console.log(
    `from a key to its diagnostic: ${median(closed).toFixed(0)} ms without a preview, ` +
      `${median(open).toFixed(0)} ms with it: ${(measured.ratio as number).toFixed(2)} times`,
  );
});

step("a click on a pixel lands on what it shows", async () => {
  await workbench.pictureIsDone();
  for (const [place, text] of [
    [WALL, "RECTANGLE {"],
    [PILLAR, "SPHERE { CENTER < -1400, -6, -1 >"],
  ] as const) {
    await workbench.clickPicture(place);
    const { line } = workbench.find(SCENE, text);
    // Not in the status bar: that is empty while the keyboard is still in the picture.
    const number = workbench.editor(SCENE).locator(".line-numbers.active-line-number");
    await number.filter({ hasText: new RegExp(`^${line}$`) }).waitFor();
  }
});

step("the picture follows the text, and says when it does not", async () => {
  const [before] = await workbench.colors([PILLAR]);
  await workbench.goTo(SCENE, "0, 0, 0.9 >\n        ROUGH 0.2 HARD 0.2 ");
  await workbench.page.keyboard.press("Delete");
  await workbench.page.keyboard.type("0.9");
  await workbench.colorBecomes(PILLAR, (now) => now !== String(before));
  await workbench.page.keyboard.type(" , ,");
  const badge = workbench.preview.locator('.m3d-badge[data-kind="stale"]');
  await badge.filter({ hasText: /^Stale: line \d+: / }).waitFor();
  await workbench.screenshot("stale");
  const line = /line (\d+)/.exec(await badge.innerText())?.[1] ?? "";
  await badge.click();
  const number = workbench.editor(SCENE).locator(".line-numbers.active-line-number");
  await number.filter({ hasText: new RegExp(`^${line}$`) }).waitFor();
  await workbench.focus(SCENE);
  await workbench.command("File: Revert File");
  await badge.waitFor({ state: "detached" });
  await workbench.pictureIsDone();
});

step("both kinds of light are shown under a slider", async () => {
  await workbench.preview.getByRole("button", { name: "Both" }).click();
  await workbench.preview.getByText(/straight \d+/).waitFor();
  await workbench.pictureIsDone();
  const slider = workbench.preview.getByRole("slider");
  await slider.press("Home");
  await workbench.preview.locator('[role=slider][aria-valuenow="0"]').waitFor();
  const [straight] = await workbench.colors([WALL]);
  await slider.press("End");
  await workbench.colorBecomes(WALL, (now) => now !== String(straight));
  for (let count = 0; count < 25; count++) {
    await slider.press("ArrowLeft");
  }
  await workbench.screenshot("both");
});

step("the picture is saved", async () => {
  const target = path.join(vscode.folder, "merman.png");
  await workbench.preview.getByRole("button", { name: "Save" }).click();
  const proposed = workbench.page.locator(".quick-input-widget:visible .quick-input-box input");
  await workbench.eventually("a file is proposed", async () => (await proposed.inputValue()) === target);
  await workbench.page.keyboard.press("Enter");
  await workbench.page.locator(".notification-toast", { hasText: "merman.png is written" }).waitFor();
  assert.equal(fs.readFileSync(target).toString("latin1", 1, 4), "PNG");
  await workbench.command("Notifications: Clear All Notifications");
});

step("a pinned preview keeps its scene, and goes on to follow the editor", async () => {
  const tab = (name: string): Locator => workbench.page.locator(`.tab[aria-label*="${name}"]`);
  await workbench.preview.getByRole("button", { name: "Pin" }).click();
  await tab(`[Preview ${SCENE}]`).waitFor();
  await workbench.openScene(BALLS);
  await workbench.command("Mirage3D: Open Preview to the Side");
  await tab(`Preview ${BALLS}`).waitFor();
  assert.equal(await tab(`[Preview ${SCENE}]`).count(), 1);
  await workbench.pictureIsDone();
  await workbench.screenshot("pinned");
  await tab(`[Preview ${SCENE}]`).click();
  await workbench.preview.getByRole("button", { name: "Pin" }).click();
  await tab(`[Preview ${SCENE}]`).waitFor({ state: "detached" });
  assert.equal(await tab("Preview ").count(), 1, "two previews follow the editor");
  await workbench.focus(SCENE);
  await tab(`Preview ${SCENE}`).waitFor();
  await workbench.pictureIsDone();
});

step("the dump opens beside the scene and follows the cursor", async () => {
  await workbench.openScene(SCENE);
  await workbench.goTo(SCENE, "RECTANGLE {");
  await workbench.command("Mirage3D: Open Dump to the Side");
  const dump = workbench.editor("m3d-dump");
  await dump.locator(".view-line", { hasText: "RECTANGLE" }).first().waitFor();
  await dump.locator(".view-overlays .cdr").first().waitFor();
  await workbench.screenshot("dump");
});

step("the compiled scene and the syntax tree show what the cursor is in", async () => {
  await workbench.command("Mirage3D: Focus on Compiled Scene View");
  const rows = workbench.page.locator(".pane-body .monaco-list-row");
  await rows.first().waitFor();
  await workbench.goTo(SCENE, "RECTANGLE {");
  await workbench.page.locator(".pane-body .monaco-list-row.selected").first().waitFor();
  await workbench.screenshot("trees");
});

step("a scene is compiled by its task", async () => {
  await workbench.command("Mirage3D: Compile Scene to .m3ir");
  const target = path.join(vscode.folder, "merman.m3ir");
  await workbench.eventually("the compiled scene is there", () => Promise.resolve(fs.existsSync(target)));
  assert.ok(fs.statSync(target).size > 1000);
});

for (const { name, theme, mark, icon } of THEMES) {
  step(`it is seen in the theme ${name}`, async () => {
    vscode.set("Workspace", { "workbench.colorTheme": theme });
    await workbench.page.locator(`.monaco-workbench.${mark}`).waitFor();
    await workbench.focus(SCENE);
    await workbench.command("Mirage3D: Open Preview to the Side");
    await workbench.preview.locator(`body.${THEME_CLASS[mark]}`).waitFor();
    await workbench.preview.getByRole("button", { name: "Both" }).click();
    await workbench.pictureIsDone();
    for (const selector of ["[aria-pressed=true]", "[aria-pressed=false]", ".m3d-side", ".m3d-pixel"]) {
      const { text } = await contrasts(workbench.preview.locator(selector).first());
      assert.ok(text >= 4.5, `${selector} has a contrast of ${text.toFixed(2)}`);
    }
    // With the keyboard, on the button that is pressed: the outline is off the button, and seen on what is there.
    await workbench.preview.locator("canvas").press("Shift+Tab");
    const pressed = workbench.preview.locator(".m3d-button[aria-pressed=true]:focus-visible").first();
    await pressed.waitFor();
    const { outline, offset } = await contrasts(pressed);
    assert.ok(offset >= 1 && outline >= 3, `the focus is drawn at ${offset} with a contrast of ${outline.toFixed(2)}`);
    const tab = workbench.page.locator('.tab[aria-label*="Preview "] .monaco-icon-label').first();
    const image = await tab.evaluate((element) => getComputedStyle(element, "::before").backgroundImage);
    assert.match(image, new RegExp(`m3d-${icon}\\.svg`));
    await workbench.screenshot(`theme-${name.replace(" ", "-")}`);
  });
}

step("a task says how it has ended", async () => {
  vscode.set("Workspace", { "workbench.colorTheme": "Default Dark Modern" });
  await workbench.openScene(SCENE);
  await workbench.command("Mirage3D: Compile Scene to .m3ir");
  await workbench.page.locator(".notification-toast", { hasText: "merman.m3ir is written." }).waitFor();
  await workbench.command("Notifications: Clear All Notifications");
});

step("what is typed by hand has one end", async () => {
  await workbench.openScene("wheel.m3d");
  const before = workbench.read("wheel.m3d").trimEnd();
  await workbench.typeAtEnd("wheel.m3d", "/* a comment */ SOLID { SPHERE { CENTER < 1, 2, 3 > } }");
  await workbench.word("wheel.m3d", "3").waitFor();
  await workbench.save();
  const typed = workbench.read("wheel.m3d").slice(before.length).replace(/\s+/g, " ").trim();
  assert.equal(typed, "/* a comment */ SOLID { SPHERE { CENTER < 1, 2, 3 > } }");
});

step("a new scene shows a mirage, and Ctrl+S in its preview saves the scene", async () => {
  await workbench.command("Mirage3D: New Scene");
  await workbench.editor("untitled").locator(".view-line", { hasText: "PROFILE" }).first().waitFor();
  await workbench.command("Mirage3D: Open Preview to the Side");
  await workbench.preview.getByRole("button", { name: "Mirage" }).click();
  await workbench.pictureIsDone();
  const [ball, below] = await workbench.colors([[0.5, 0.35], [0.5, 0.78]]);
  for (const [red = 0, , blue = 0] of [ball ?? [], below ?? []]) {
    assert.ok(red > blue, "the ball is seen twice");
  }
  await workbench.screenshot("new-scene");
  await workbench.preview.locator("canvas").press("Control+s");
  const proposed = workbench.page.locator(".quick-input-widget:visible .quick-input-box input");
  await workbench.eventually("a file is proposed", async () => (await proposed.inputValue()).includes(vscode.folder));
  await proposed.fill(path.join(vscode.folder, "new.m3d"));
  await workbench.page.keyboard.press("Enter");
  await workbench.eventually("it is saved", () => Promise.resolve(fs.existsSync(path.join(vscode.folder, "new.m3d"))));
});

step("how long the extension takes to start", async () => {
  await workbench.command("Developer: Show Running Extensions");
  const row = workbench.page.locator(".runtime-extensions-editor .monaco-list-row", { hasText: "mirage3d" }).first();
  await row.waitFor();
  const text = await row.innerText();
  measured.activation = /(\d+)ms/.exec(text)?.[0];
  console.log(`the extension starts in ${String(measured.activation)}`);
});

step("a preview comes back as it was when the window is opened again", async () => {
  await workbench.openScene(SCENE);
  await workbench.command("Mirage3D: Open Preview to the Side");
  const pinned = workbench.page.locator(`.tab[aria-label*="[Preview ${SCENE}]"]`);
  await workbench.preview.getByRole("button", { name: "Straight" }).click();
  await workbench.preview.getByRole("button", { name: "Pin" }).click();
  await pinned.waitFor();
  await workbench.pictureIsDone();
  const colors = await workbench.colors([SKY, PILLAR, WALL]);
  await workbench.reload();
  await pinned.waitFor();
  await workbench.preview.getByRole("button", { name: "Straight", pressed: true }).waitFor();
  await workbench.preview.getByRole("button", { name: "Pin", pressed: true }).waitFor();
  await workbench.pictureIsDone();
  assert.deepEqual(await workbench.colors([SKY, PILLAR, WALL]), colors);
  await workbench.screenshot("back");
});
