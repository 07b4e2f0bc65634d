/** A VS Code of its own for a test run: the real one as a server, with the packed extension and a folder of scenes. */

import { spawn, spawnSync, type ChildProcess } from "node:child_process";
import * as fs from "node:fs";
import * as net from "node:net";
import * as os from "node:os";
import * as path from "node:path";

const REPOSITORY = process.env.REPOSITORY ?? process.cwd();
export const OUT = process.env.OUT ?? path.join(REPOSITORY, "out");
const ENTRY = path.join(OUT, "e2e/node_modules/code-server/out/node/entry.js");

/** The language server of this repository. */
export const SERVER = path.join(REPOSITORY, ".venv/bin/m3d-lsp");

const SETTINGS = {
  "telemetry.telemetryLevel": "off",
  "workbench.startupEditor": "none",
  "workbench.tips.enabled": false,
  "extensions.autoUpdate": false,
  "extensions.autoCheckUpdates": false,
  "update.mode": "none",
  "git.enabled": false,
  "editor.hover.delay": 100,
  "editor.fontSize": 13,
  "editor.minimap.enabled": false,
  "window.commandCenter": false,
  "files.autoSave": "off",
  "files.simpleDialog.enable": true,
  "workbench.editor.enablePreview": false,
};

export interface VSCode {
  /** What to open in a browser. */
  url: string;
  /** The folder of the scenes. */
  folder: string;
  /** Changes settings of the machine or the workspace, as if their files were edited; VS Code follows. */
  set(whose: "Machine" | "Workspace", changes: Record<string, unknown>): void;
  stop(): Promise<void>;
}

/**
 * Starts one; its workspace has the examples of the repository and, in `.venv`, its programs. A workspace that is not
 * `trusted` is opened in Restricted Mode, and the machine's settings name the server. `server` is another server.
 */
export async function startVSCode(name: string, trusted: boolean, server?: string): Promise<VSCode> {
  const run = fs.mkdtempSync(path.join(os.tmpdir(), "m3d-workbench-"));
  const folder = path.join(run, "scenes");
  fs.mkdirSync(folder);
  for (const name of fs.readdirSync(path.join(REPOSITORY, "examples")).filter((name) => name.endsWith(".m3d"))) {
    fs.copyFileSync(path.join(REPOSITORY, "examples", name), path.join(folder, name));
  }
  fs.symlinkSync(path.join(REPOSITORY, ".venv"), path.join(folder, ".venv"));
  fs.mkdirSync(path.join(run, "data/User"), { recursive: true });
  fs.mkdirSync(path.join(run, "data/Machine"));
  fs.mkdirSync(path.join(run, "home"));
  const settings = {
    ...SETTINGS,
    "files.exclude": { ".venv": true, ".vscode": true },
    "security.workspace.trust.enabled": !trusted,
    "security.workspace.trust.startupPrompt": "never",
  };
  fs.writeFileSync(path.join(run, "data/User/settings.json"), JSON.stringify(settings, null, 2));
  fs.mkdirSync(path.join(folder, ".vscode"));
  const files = { Machine: "data/Machine/settings.json", Workspace: "scenes/.vscode/settings.json" };
  const own: Record<"Machine" | "Workspace", Record<string, unknown>> = {
    Workspace: {},
    Machine: trusted && server === undefined ? {} : { "m3d.server.path": server ?? SERVER },
  };
  const set: VSCode["set"] = (whose, changes) => {
    Object.assign(own[whose], changes);
    fs.writeFileSync(path.join(run, files[whose]), JSON.stringify(own[whose], null, 2));
  };
  set("Workspace", {});
  set("Machine", {});

  const env: NodeJS.ProcessEnv = { ...process.env, EXTENSIONS_GALLERY: "{}", HOME: path.join(run, "home") };
  // Within a terminal of VS Code the command line would talk to that one.
  delete env.VSCODE_IPC_HOOK_CLI;
  const places = ["--config", "config.yaml", "--user-data-dir", "data", "--extensions-dir", "ext"].map((word) =>
    word.startsWith("--") ? word : path.join(run, word),
  );
  const installed = spawnSync(process.execPath, [ENTRY, ...places, "--install-extension", vsix()], {
    env,
    encoding: "utf8",
  });
  if (installed.status !== 0) {
    throw new Error(`the extension cannot be installed:\n${installed.stdout}${installed.stderr}`);
  }
  const port = await freePort();
  const log = fs.openSync(path.join(OUT, `${name}.log`), "w");
  const options =
    "--auth none --disable-telemetry --disable-update-check --disable-getting-started-override --ignore-last-opened" +
    (trusted ? " --disable-workspace-trust" : "");
  const code = spawn(
    process.execPath,
    [ENTRY, ...places, ...options.split(" "), "--bind-addr", `127.0.0.1:${port}`],
    { env, stdio: ["ignore", log, log] },
  );
  const url = `http://127.0.0.1:${port}`;
  await answers(`${url}/healthz`, code, `${name}.log`);
  return {
    url: `${url}/?folder=${folder}`,
    folder,
    set,
    stop: async () => {
      await ended(code);
      fs.rmSync(run, { recursive: true, force: true });
    },
  };
}

function vsix(): string {
  const [name] = fs.readdirSync(OUT).filter((name) => name.endsWith(".vsix"));
  if (name === undefined) {
    throw new Error(`there is no packed extension in ${OUT}; make vsix writes it`);
  }
  return path.join(OUT, name);
}

function freePort(): Promise<number> {
  return new Promise((resolve) => {
    const probe = net.createServer().listen(0, "127.0.0.1", () => {
      const { port } = probe.address() as net.AddressInfo;
      probe.close(() => resolve(port));
    });
  });
}

async function answers(url: string, server: ChildProcess, log: string): Promise<void> {
  for (let tries = 0; tries < 3000 && server.exitCode === null; tries++) {
    try {
      if ((await fetch(url)).ok) {
        return;
      }
    } catch {
      // Not yet.
    }
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`VS Code does not answer; ${path.join(OUT, log)} may tell why`);
}

function ended(server: ChildProcess): Promise<void> {
  return new Promise((resolve) => {
    if (server.exitCode !== null) {
      resolve();
      return;
    }
    server.once("exit", () => resolve());
    server.kill("SIGTERM");
  });
}
