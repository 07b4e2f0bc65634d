/** The language server: started, watched, restarted, asked. */

import { spawn, type ChildProcess } from "node:child_process";
import * as vscode from "vscode";
import {
  CloseAction,
  ErrorAction,
  LanguageClient,
  State,
  type CancellationToken,
  type LanguageClientOptions,
  type RequestType,
  type StaticFeature,
} from "vscode-languageclient/node";

import { within } from "./deadline";
import { Ends } from "./ends";
import * as protocol from "./protocol";
import { server as findServer } from "./surroundings";

export type ServerState =
  | { kind: "starting" }
  | { kind: "running"; program: string; version: string }
  | { kind: "missing"; looked: string[] }
  | { kind: "failed"; reason: string };

/** The name that the server gives itself. */
const NAME = "m3d-lsp";
const IS_IT = `Is it ${NAME}?`;

/** How long the server may take to answer at its start, and to end when it is asked to, in ms. */
const TO_ANSWER = 60_000;
const TO_END = 2000;

/** A client that leaves it to the extension to tell people what is the matter, and to stop what has not started. */
class Client extends LanguageClient {
  override error(message: string, data?: unknown): void {
    super.error(message, data, false);
  }

  override stop(timeout?: number): Promise<void> {
    return this.state === State.Running ? super.stop(timeout) : Promise.resolve();
  }
}

/** A server as it runs: the client that talks to it, and its process. */
interface Running {
  client: LanguageClient;
  process: ChildProcess;
}

const ours: StaticFeature = {
  fillClientCapabilities: (capabilities) => {
    capabilities.experimental = { ...(capabilities.experimental as object | undefined), ...protocol.experimental };
  },
  initialize: () => undefined,
  getState: () => ({ kind: "static" }),
  clear: () => undefined,
};

export class Server implements vscode.Disposable {
  readonly output = vscode.window.createOutputChannel("Mirage3D", { log: true });
  private readonly stateChanged = new vscode.EventEmitter<ServerState>();
  private readonly analysedAgain = new vscode.EventEmitter<protocol.Analysed>();
  private readonly tileCame = new vscode.EventEmitter<protocol.Tile>();
  readonly onDidChangeState = this.stateChanged.event;
  readonly onDidAnalyse = this.analysedAgain.event;
  readonly onTile = this.tileCame.event;

  private running: Running | undefined;
  private current: ServerState = { kind: "starting" };
  private turn: Promise<void> = Promise.resolve();
  private readonly ends = new Ends();
  /** The program that has run as a server last: if it ends early, it is not for being the wrong one. */
  private proven: string | undefined;

  get state(): ServerState {
    return this.current;
  }

  /** Starts the server, or ends it and starts what is found now: a person, or a setting, wants it. */
  restart(): Promise<void> {
    this.ends.forget();
    return this.startAnew();
  }

  /** Ends the server. One that has not answered yet is not waited for. */
  async stop(): Promise<void> {
    const { running } = this;
    this.running = undefined;
    if (running === undefined) {
      return;
    }
    try {
      await running.client.stop(TO_END);
    } catch (fault) {
      this.output.warn(`the language server did not stop properly: ${String(fault)}`);
    }
    await end(running.process);
  }

  /** Asks the server. Throws while it does not run, and what it answers as an error. */
  async request<P, R>(type: RequestType<P, R, void>, params: P, token?: CancellationToken): Promise<R> {
    if (this.running === undefined || this.current.kind !== "running") {
      throw new Error("the language server does not run");
    }
    const { client } = this.running;
    return token === undefined ? client.sendRequest(type, params) : client.sendRequest(type, params, token);
  }

  dispose(): void {
    void this.stop();
    this.output.dispose();
    this.stateChanged.dispose();
    this.analysedAgain.dispose();
    this.tileCame.dispose();
  }

  /** One start is carried out after the other; one that is still waiting for its server's answer is given up. */
  private startAnew(): Promise<void> {
    if (this.running !== undefined && this.running.client.state !== State.Running) {
      void end(this.running.process);
    }
    this.turn = this.turn.then(async () => {
      await this.stop();
      await this.start();
    });
    return this.turn;
  }

  private async start(): Promise<void> {
    const found = findServer();
    if (!("program" in found)) {
      this.output.warn(`${NAME} was not found. Looked at: ${found.looked.join(", ")}`);
      this.become({ kind: "missing", looked: found.looked });
      return;
    }
    const { program } = found;
    this.become({ kind: "starting" });
    this.output.info(`starting ${program} (from the ${found.where})`);
    const process = spawn(program, ["--stdio"], { stdio: "pipe" });
    const client = new Client(
      "m3d",
      "Mirage3D",
      () => Promise.resolve(process),
      this.clientOptions(() => this.hasEnded(process)),
    );
    client.registerFeature(ours);
    client.onNotification(protocol.analysed, (analysed) => this.analysedAgain.fire(analysed));
    client.onNotification(protocol.tile, (tile) => this.tileCame.fire(tile));
    this.running = { client, process };
    const ended = new Promise<never>((_, reject) => {
      process.once("error", (fault) => reject(new Error(`${program} cannot be started: ${fault.message}. ${IS_IT}`)));
      process.once("exit", (status, signal) => {
        const how = signal ?? `status ${status ?? "unknown"}`;
        reject(new Error(`${program} ended (${how}) before it answered. ${IS_IT}`));
      });
    });
    const late = `${program} has not answered within ${TO_ANSWER / 1000} s. ${IS_IT}`;
    // When a server ends meanwhile, its client may count as started, or fail with what the pipe says ("write EPIPE"),
    // before the process is seen to have ended: then it is waited for.
    const closed = `${program} closed the connection before it answered. ${IS_IT}`;
    const answered = client.start().then(
      () => (client.state === State.Running && client.initializeResult ? undefined : within(TO_END, closed, ended)),
      (fault: unknown) => within(TO_END, fault instanceof Error ? fault.message : String(fault), ended),
    );
    try {
      await within(TO_ANSWER, late, Promise.race([answered, ended]));
      const { name, version = "" } = client.initializeResult?.serverInfo ?? { name: "without a name" };
      if (name !== NAME) {
        throw new Error(`${program} is another language server, ${name}. ${NAME} is wanted.`);
      }
      this.proven = program;
      this.become({ kind: "running", program, version });
    } catch (fault) {
      // Given up for another start, it has not failed.
      const hasFailed = this.isRunning(process) && !process.killed;
      const hasEnded = process.exitCode !== null || process.signalCode !== null;
      await this.stop();
      if (hasFailed && hasEnded && program === this.proven) {
        this.startAgain();
      } else if (hasFailed) {
        this.fail(fault instanceof Error ? fault.message : String(fault));
      }
    }
  }

  private clientOptions(ended: () => void): LanguageClientOptions {
    return {
      documentSelector: [
        { language: "m3d", scheme: "file" },
        { language: "m3d", scheme: "untitled" },
      ],
      outputChannel: this.output,
      // Told without being asked: servers need not register for it.
      // eslint-disable-next-line @typescript-eslint/no-deprecated
      synchronize: { configurationSection: "m3d" },
      initializationFailedHandler: () => false,
      errorHandler: {
        error: () => ({ action: ErrorAction.Continue, handled: true }),
        closed: () => {
          ended();
          return { action: CloseAction.DoNotRestart, handled: true, message: "the connection is closed" };
        },
      },
    };
  }

  /** A server has ended without being asked to. */
  private hasEnded(process: ChildProcess): void {
    if (!this.isRunning(process) || this.current.kind !== "running") {
      return;
    }
    this.running = undefined;
    void end(process);
    this.startAgain();
  }

  /** Starts a server that has ended, unless that happens too often. */
  private startAgain(): void {
    if (this.ends.add(Date.now())) {
      this.output.warn("the language server has ended; starting it again");
      this.become({ kind: "starting" });
      void this.startAnew();
    } else {
      this.fail(`The language server has ended ${this.ends.count} times in 3 minutes.`);
    }
  }

  private isRunning(process: ChildProcess): boolean {
    return this.running?.process === process;
  }

  private fail(reason: string): void {
    this.output.error(reason);
    this.become({ kind: "failed", reason });
  }

  private become(state: ServerState): void {
    this.current = state;
    void vscode.commands.executeCommand("setContext", "m3d.serverRuns", state.kind === "running");
    void vscode.commands.executeCommand("setContext", "m3d.server", state.kind);
    this.stateChanged.fire(state);
  }
}

/** Ends a process if it has not ended: as one asks, and if that does not help, as one must. */
async function end(process: ChildProcess): Promise<void> {
  if (process.pid === undefined || process.exitCode !== null || process.signalCode !== null) {
    return;
  }
  const exit = new Promise((resolve) => process.once("exit", resolve));
  process.kill();
  try {
    await within(TO_END, "it goes on", exit);
  } catch {
    process.kill("SIGKILL");
  }
}
