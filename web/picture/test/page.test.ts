/// <reference types="vite/client" />
/** The bundle in a page that has no editor: test/page, with its own host. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";

import type { Host } from "../src/host";
import type { Preview } from "../src/preview";
import html from "./page/index.html?raw";

const drawn: { width: number; height: number; data: Uint8ClampedArray }[] = [];

beforeEach(() => {
  drawn.length = 0;
  vi.stubGlobal(
    "ImageData",
    class {
      constructor(
        readonly data: Uint8ClampedArray,
        readonly width: number,
        readonly height: number,
      ) {}
    },
  );
  const putImageData = (image: never): number => drawn.push(image);
  const get = (_: unknown, name: string): unknown => (name === "putImageData" ? putImageData : () => undefined);
  vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(new Proxy({}, { get, set: () => true }) as never);
  vi.spyOn(HTMLElement.prototype, "clientWidth", "get").mockReturnValue(40);
  vi.spyOn(HTMLElement.prototype, "clientHeight", "get").mockReturnValue(20);
});

afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

test("any page can show a picture", async () => {
  const root = document.createElement("main");
  expect(html).toContain('<main id="picture"></main>');
  document.body.append(root);
  // What the page's own script does: this document runs none.
  const picture = (await import(/* @vite-ignore */ `${here}/../dist/picture.js`)) as { Preview: typeof Preview };
  const host = (await import(/* @vite-ignore */ `${here}/page/disc.js`)) as { Disc: new () => Host };
  new picture.Preview(root, new host.Disc());
  await vi.waitFor(() => expect(drawn.length).toBeGreaterThan(0));
  const [image] = drawn;
  expect([image?.width, image?.height]).toEqual([40, 20]);
  const at = (x: number, y: number): number[] => [...(image?.data ?? [])].slice(4 * (40 * y + x)).slice(0, 4);
  expect(at(20, 10)).toEqual([255, 240, 120, 255]);
  expect(at(0, 0)).toEqual([30, 60, 140, 255]);
  await vi.waitFor(() => expect(root.textContent).toContain("mirage 40 × 20 in"));
});

test("the picture part imports nothing but itself", () => {
  const sources = import.meta.glob<string>("../src/*.ts", { query: "?raw", import: "default", eager: true });
  expect(Object.keys(sources).length).toBeGreaterThan(5);
  for (const [name, source] of Object.entries(sources)) {
    const imported = [...source.matchAll(/(?:from|import) "([^"]+)"/g)].map(([, path]) => path);
    expect(imported.filter((path) => path?.startsWith("./") !== true), name).toEqual([]);
  }
});

const here = new URL(".", import.meta.url).pathname;
