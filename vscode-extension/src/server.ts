/** The language server: started, watched, restarted, asked. */

import * as vscode from "vscode";
import {
  CloseAction,
  ErrorAction,
  LanguageClient,
  State,
  type CancellationToken,
  type LanguageClientOptions,
  type RequestType,
  type ServerOptions,
  type StaticFeature,
} from "vscode-languageclient/node";

import * as protocol from "./protocol";
import { server as findServer } from "./surroundings";

export type ServerState =
  | { kind: "starting" }
  | { kind: "running"; program: string; version: string }
  | { kind: "missing"; looked: string[] }
  | { kind: "failed"; reason: string };

/** A server that ends so often within so many ms is not started again by itself. */
const MOST_ENDS = 4;
const WITHIN = 180_000;

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

  private client: LanguageClient | undefined;
  private current: ServerState = { kind: "starting" };
  private turn: Promise<void> = Promise.resolve();
  private ends: number[] = [];

  get state(): ServerState {
    return this.current;
  }

  /** Starts the server, or stops it and starts what is found now. One such wish is carried out after the other. */
  restart(): Promise<void> {
    this.turn = this.turn.then(async () => {
      await this.stop();
      await this.start();
    });
    return this.turn;
  }

  async stop(): Promise<void> {
    const { client } = this;
    this.client = undefined;
    try {
      await client?.stop();
    } catch (fault) {
      this.output.warn(`the language server did not stop properly: ${String(fault)}`);
    }
  }

  /** Asks the server. Throws while it does not run, and what it answers as an error. */
  async request<P, R>(type: RequestType<P, R, void>, params: P, token?: CancellationToken): Promise<R> {
    if (this.client === undefined || this.current.kind !== "running") {
      throw new Error("the language server does not run");
    }
    return token === undefined ? this.client.sendRequest(type, params) : this.client.sendRequest(type, params, token);
  }

  dispose(): void {
    void this.stop();
    this.output.dispose();
    this.stateChanged.dispose();
    this.analysedAgain.dispose();
    this.tileCame.dispose();
  }

  private async start(): Promise<void> {
    const found = findServer();
    if (!("program" in found)) {
      this.output.warn(`m3d-lsp was not found. Looked at: ${found.looked.join(", ")}`);
      this.become({ kind: "missing", looked: found.looked });
      return;
    }
    this.become({ kind: "starting" });
    this.output.info(`starting ${found.program} (from the ${found.where})`);
    const options: ServerOptions = { command: found.program, args: ["--stdio"] };
    const client = new LanguageClient("m3d", "Mirage3D", options, this.clientOptions());
    this.client = client;
    client.registerFeature(ours);
    client.onNotification(protocol.analysed, (analysed) => this.analysedAgain.fire(analysed));
    client.onNotification(protocol.tile, (tile) => this.tileCame.fire(tile));
    client.onDidChangeState(({ newState }) => {
      if (client === this.client) {
        this.follow(client, newState, found.program);
      }
    });
    try {
      await client.start();
    } catch (fault) {
      this.become({ kind: "failed", reason: fault instanceof Error ? fault.message : String(fault) });
    }
  }

  private follow(client: LanguageClient, state: State, program: string): void {
    if (state === State.Running) {
      const version = client.initializeResult?.serverInfo?.version ?? "";
      this.become({ kind: "running", program, version });
    } else if (state === State.Starting) {
      this.become({ kind: "starting" });
    } else if (this.current.kind !== "failed") {
      this.become({ kind: "failed", reason: "The language server has ended." });
    }
  }

  private clientOptions(): LanguageClientOptions {
    return {
      documentSelector: [
        { language: "m3d", scheme: "file" },
        { language: "m3d", scheme: "untitled" },
      ],
      outputChannel: this.output,
      // Told without being asked: servers need not register for it.
      // eslint-disable-next-line @typescript-eslint/no-deprecated
      synchronize: { configurationSection: "m3d" },
      errorHandler: {
        error: () => ({ action: ErrorAction.Continue, handled: true }),
        closed: () => this.closed(),
      },
    };
  }

  private closed(): { action: CloseAction; handled: boolean } {
    const now = Date.now();
    this.ends = [...this.ends.filter((end) => now - end < WITHIN), now];
    if (this.ends.length <= MOST_ENDS) {
      this.output.warn("the language server has ended; starting it again");
      return { action: CloseAction.Restart, handled: true };
    }
    this.become({ kind: "failed", reason: `The language server has ended ${this.ends.length} times in 3 minutes.` });
    return { action: CloseAction.DoNotRestart, handled: true };
  }

  private become(state: ServerState): void {
    this.current = state;
    void vscode.commands.executeCommand("setContext", "m3d.serverRuns", state.kind === "running");
    this.stateChanged.fire(state);
  }
}
