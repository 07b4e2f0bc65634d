/** A host whose answers a test gives when it likes. */

import type { Choice, Events, Hit, Host, Mask, Optics, Pixel, Rendered, RenderRequest, Tile } from "../src/host";

export interface Asked {
  request: RenderRequest;
  tile(tile: Tile): void;
  answer(answer: Partial<Rendered>): Promise<void>;
  fail(message: string): Promise<void>;
}

export class FakeHost implements Host {
  readonly asked: Asked[] = [];
  readonly calls: unknown[][] = [];
  events: Events | undefined;
  hit: Hit | null = null;
  pickFails: string | null = null;
  maskFound: Mask | null = null;

  listen(events: Events): void {
    this.events = events;
  }

  render(request: RenderRequest, tile: (tile: Tile) => void): Promise<Rendered> {
    return new Promise((resolve, reject) => {
      const whole = {
        version: 1,
        stale: false,
        width: 2,
        height: 2,
        aspect: 1,
        ownWidth: 2,
        ownHeight: 2,
        seconds: 1,
        bent: true,
      };
      this.asked.push({
        request,
        tile,
        answer: async (answer) => {
          resolve({ status: "done", ...whole, ...answer });
          await settled();
        },
        fail: async (message) => {
          reject(new Error(message));
          await settled();
        },
      });
    });
  }

  pick(optics: Optics, { x, y, width, height }: Pixel): Promise<Hit | null> {
    this.calls.push(["pick", optics, x, y, `of ${width} x ${height}`]);
    return this.pickFails === null ? Promise.resolve(this.hit) : Promise.reject(new Error(this.pickFails));
  }

  mask(optics: Optics): Promise<Mask | null> {
    this.calls.push(["mask", optics]);
    return Promise.resolve(this.maskFound);
  }

  reveal(hit: Hit, whole: boolean): void {
    this.calls.push(["reveal", hit.line, whole]);
  }

  save(optics: Optics): void {
    this.calls.push(["save", optics]);
  }

  pin(pinned: boolean): void {
    this.calls.push(["pin", pinned]);
  }

  carryOut(action: string): void {
    this.calls.push(["carryOut", action]);
  }

  showProblem(): void {
    this.calls.push(["showProblem"]);
  }

  showOutput(): void {
    this.calls.push(["showOutput"]);
  }

  chose(choice: Choice): void {
    this.calls.push(["chose", choice]);
  }
}

/** Lets everything run that waits for an answer. */
export async function settled(): Promise<void> {
  for (let turn = 0; turn < 10; turn++) {
    await Promise.resolve();
  }
}

/** A whole picture of 2 x 2 pixels in one colour. */
export function plain(red: number, step = 1): Tile {
  const count = step === 1 ? 2 : 1;
  const pixels = new Uint8Array(count * count * 3).fill(0).map((_, index) => (index % 3 === 0 ? red : 0));
  return { preview: "", version: 1, width: 2, height: 2, top: 0, step, columns: count, rows: count, pixels };
}
