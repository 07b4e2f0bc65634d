/** The page of a preview in VS Code: the picture part, with the extension as its host. */

import type {
  Choice,
  Events,
  Hit,
  Host,
  Mask,
  Optics,
  Options,
  Pixel,
  Rendered,
  RenderRequest,
  Tile,
} from "mirage3d-picture/host";
import { Preview } from "mirage3d-picture";
import type { Answer, FromPage, Kept, ToPage } from "./messages";

import "mirage3d-picture/style.css";
import "./theme.css";

declare function acquireVsCodeApi(): {
  postMessage(message: FromPage): void;
  getState(): Partial<Kept> | undefined;
  setState(state: Partial<Kept>): void;
};

interface Question {
  resolve(answer: Answer): void;
  reject(fault: Error): void;
  tile?: (tile: Tile) => void;
}

class Extension implements Host {
  private readonly api = acquireVsCodeApi();
  private readonly questions = new Map<number, Question>();
  private last = 0;
  /** What was chosen before VS Code was closed: it counts more than the settings do, until these change. */
  private remembered: Choice | null = this.api.getState()?.chosen ?? {};

  listen(events: Events): void {
    window.addEventListener("message", ({ data }: MessageEvent<ToPage>) => this.take(data, events));
    this.api.postMessage({ type: "ready" });
  }

  render(request: RenderRequest, tile: (tile: Tile) => void): Promise<Rendered> {
    return this.ask((id) => ({ type: "render", id, request }), tile) as Promise<Rendered>;
  }

  pick(optics: Optics, pixel: Pixel): Promise<Hit | null> {
    return this.ask((id) => ({ type: "pick", id, optics, pixel })) as Promise<Hit | null>;
  }

  mask(optics: Optics): Promise<Mask | null> {
    return this.ask((id) => ({ type: "mask", id, optics })) as Promise<Mask | null>;
  }

  reveal(hit: Hit, whole: boolean): void {
    this.api.postMessage({ type: "reveal", hit, whole });
  }

  save(optics: Optics): void {
    this.api.postMessage({ type: "save", optics });
  }

  pin(pinned: boolean): void {
    this.api.postMessage({ type: "pin", pinned });
  }

  carryOut(action: string): void {
    this.api.postMessage({ type: "action", action });
  }

  showProblem(): void {
    this.api.postMessage({ type: "problem" });
  }

  showOutput(): void {
    this.api.postMessage({ type: "output" });
  }

  chose(choice: Choice): void {
    this.keep({ chosen: { ...this.api.getState()?.chosen, ...choice } });
  }

  private keep(part: Partial<Kept>): void {
    this.api.setState({ ...this.api.getState(), ...part });
  }

  private ask(message: (id: number) => FromPage, tile?: (tile: Tile) => void): Promise<Answer> {
    const id = ++this.last;
    return new Promise((resolve, reject) => {
      this.questions.set(id, { resolve, reject, ...(tile && { tile }) });
      this.api.postMessage(message(id));
    });
  }

  private take(message: ToPage, events: Events): void {
    switch (message.type) {
      case "answer":
        this.close(message.id)?.resolve(message.answer);
        break;
      case "failed":
        this.close(message.id)?.reject(new Error(message.message));
        break;
      case "tile":
        this.questions.get(message.tile.job ?? 0)?.tile?.(message.tile);
        break;
      case "scene":
        this.keep({ uri: message.scene.id });
        events.scene(message.scene);
        break;
      case "options":
        this.options(message.options, events);
        break;
      case "visible":
        events.visible(message.visible);
        break;
      case "blocked":
        events.blocked(message.obstacle);
        break;
      default:
        events[message.type]();
    }
  }

  private options(options: Partial<Options>, events: Events): void {
    events.options({ ...options, ...this.remembered });
    if (this.remembered === null && options.show !== undefined) {
      this.keep({ chosen: {} });
    }
    if (options.pinned !== undefined) {
      this.keep({ pinned: options.pinned });
    }
    this.remembered = null;
  }

  private close(id: number): Question | undefined {
    const question = this.questions.get(id);
    this.questions.delete(id);
    return question;
  }
}

new Preview(document.body, new Extension());
