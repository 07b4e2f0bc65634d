/** A folder that nobody has said to trust: its scenes are edited with all help, and nothing is rendered until it is. */

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { stepper } from "./step";
import { startVSCode, type VSCode } from "./vscode";
import { Workbench } from "./workbench";

const SCENE = "merman.m3d";
const PILLAR: [number, number] = [0.289, 0.475];

let vscode: VSCode;
let workbench: Workbench;
const step = stepper(() => workbench);

before(async () => {
  vscode = await startVSCode("restricted", false);
  workbench = await Workbench.open(vscode);
});

after(async () => {
  await workbench.close();
  await vscode.stop();
});

step("the server runs, and tells what it does not do", async () => {
  await workbench.openScene(SCENE);
  await workbench.page.locator('.statusbar-item[aria-label*="Restricted Mode: nothing is rendered"]').waitFor();
});

step("errors are shown as they are typed", async () => {
  await workbench.goTo(SCENE, "VIEW");
  await workbench.page.keyboard.type("X");
  await workbench.editor(SCENE).locator(".squiggly-error").first().waitFor();
  await workbench.page.keyboard.press("Backspace");
  await workbench.editor(SCENE).locator(".squiggly-error").first().waitFor({ state: "detached" });
});

step("the preview says why it has no picture", async () => {
  await workbench.command("Mirage3D: Open Preview to the Side");
  await workbench.preview.getByText(/Nothing is rendered in Restricted Mode/).first().waitFor();
  assert.equal(await workbench.preview.getByLabel("Zoom").innerText(), "–");
  await workbench.screenshot("restricted");
});

step("once the folder is trusted the picture comes", async () => {
  await workbench.command("Workspaces: Manage Workspace Trust");
  await workbench.page.locator(".workspace-trust-editor").getByRole("button", { name: /^Trust$/ }).click();
  await workbench.pictureIsDone();
  const [[red = 0, green = 0, blue = 0] = []] = await workbench.colors([PILLAR]);
  assert.ok(blue > 100 && red < 60 && green < 60, "the pillar is blue");
  await workbench.screenshot("trusted");
});
