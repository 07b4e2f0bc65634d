/** What becomes of the language server: one that never answers, another program, one that is killed. */

import assert from "node:assert/strict";
import * as fs from "node:fs";
import * as os from "node:os";
import * as path from "node:path";
import { after, before } from "node:test";

import { stepper } from "./step";
import { SERVER, startVSCode, type VSCode } from "./vscode";
import { Workbench } from "./workbench";

const SCENE = "merman.m3d";
const RUNS = "Mirage3D: the language server runs";

/** A program that says in a file which process it is, and then becomes another. */
function program(name: string, becomes: string): string {
  const file = path.join(folder, name);
  fs.writeFileSync(file, `#!/bin/sh\necho $$ >> ${file}.pids\nexec ${becomes}\n`, { mode: 0o755 });
  return file;
}

/** The processes that a program has been, the last one last. */
function processes(file: string): number[] {
  return fs.existsSync(`${file}.pids`) ? fs.readFileSync(`${file}.pids`, "utf8").trim().split("\n").map(Number) : [];
}

function isAlive(process_: number): boolean {
  try {
    process.kill(process_, 0);
    return true;
  } catch {
    return false;
  }
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "m3d-servers-"));
const silent = program("silent", "sleep 1000000");
const good = program("good", `${SERVER} "$@"`);
const other = program("other", `${path.join(path.dirname(SERVER), "python")} ${path.join(folder, "other.py")}`);
fs.writeFileSync(
  path.join(folder, "other.py"),
  `import json, sys
length = int(sys.stdin.buffer.readline().split()[1])
sys.stdin.buffer.readline()
request = json.loads(sys.stdin.buffer.read(length))
result = {"capabilities": {}, "serverInfo": {"name": "another-ls"}}
answer = json.dumps({"jsonrpc": "2.0", "id": request["id"], "result": result})
sys.stdout.write(f"Content-Length: {len(answer)}\\r\\n\\r\\n{answer}")
sys.stdout.flush()
sys.stdin.read()
`,
);

let vscode: VSCode;
let workbench: Workbench;
const step = stepper(() => workbench);

function choose(file: string): void {
  vscode.set("Machine", { "m3d.server.path": file });
}

/** Waits until a program has been so many processes, and gives the last. */
async function started(file: string, count: number): Promise<number> {
  await workbench.eventually(`${path.basename(file)} runs`, () => Promise.resolve(processes(file).length >= count));
  return processes(file).at(-1) ?? 0;
}

async function gone(process_: number): Promise<void> {
  await workbench.eventually("the process has ended", () => Promise.resolve(!isAlive(process_)));
}

before(async () => {
  vscode = await startVSCode("server", true, silent);
  workbench = await Workbench.open(vscode);
});

after(async () => {
  await workbench.close();
  await vscode.stop();
  fs.rmSync(folder, { recursive: true, force: true });
});

step("while the server does not answer, the preview says so readably", async () => {
  await workbench.openScene(SCENE);
  await workbench.statusIs("Mirage3D: the language server is starting");
  await workbench.command("Mirage3D: Open Preview to the Side");
  await workbench.preview.locator(".m3d-blocked", { hasText: "The language server is starting" }).waitFor();
  assert.equal(await workbench.preview.locator(".m3d-badge:visible").count(), 0);
  await workbench.command("Mirage3D: Focus on Compiled Scene View");
  await workbench.page.getByText("The language server is starting...").first().waitFor();
  await workbench.screenshot("starting");
});

step("Restart gives it up", async () => {
  const first = await started(silent, 1);
  await workbench.command("Mirage3D: Restart Language Server");
  await started(silent, 2);
  await gone(first);
});

step("the right program runs as soon as it is chosen, and the silent one is gone", async () => {
  const last = await started(silent, 2);
  choose(good);
  await workbench.statusIs(RUNS);
  await workbench.pictureIsDone();
  await gone(last);
});

step("a server that is killed is started again, and nothing is left to say about it", async () => {
  const killed = await started(good, 1);
  process.kill(killed, "SIGKILL");
  await started(good, 2);
  await workbench.statusIs(RUNS);
  await workbench.preview.locator(".m3d-blocked").waitFor({ state: "hidden" });
  await workbench.pictureIsDone();
  assert.equal(await workbench.page.locator(".notification-toast").count(), 0);
});

step("one that keeps being killed is left alone, until a person starts it", async () => {
  for (let round = 2; round <= 5; round++) {
    process.kill(await started(good, round), "SIGKILL");
  }
  const text = "has ended 5 times in 3 minutes";
  await workbench.page.locator(".notification-toast", { hasText: text }).waitFor();
  await workbench.preview.locator(".m3d-blocked", { hasText: text }).waitFor();
  await workbench.page.getByText("The language server does not run.").first().waitFor();
  await workbench.screenshot("failed");
  await workbench.preview.getByRole("button", { name: "Try Again" }).click();
  await started(good, 6);
  await workbench.statusIs(RUNS);
  await workbench.pictureIsDone();
  // What was before counts no longer.
  process.kill(await started(good, 6), "SIGKILL");
  await started(good, 7);
  await workbench.statusIs(RUNS);
  await workbench.command("Notifications: Clear All Notifications");
});

step("another language server is not taken for this one", async () => {
  choose(other);
  await workbench.page.locator(".notification-toast", { hasText: "is another language server, another-ls" }).waitFor();
  await gone(await started(other, 1));
  await workbench.command("Notifications: Clear All Notifications");
});

step("a server that does not answer ends with its window", async () => {
  const before = processes(silent).length;
  choose(silent);
  const left = await started(silent, before + 1);
  choose(good);
  await workbench.statusIs(RUNS);
  await gone(left);
  choose(silent);
  const open = await started(silent, before + 2);
  await workbench.reload();
  await gone(open);
});
