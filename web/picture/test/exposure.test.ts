/** When a picture is made anew, and what is seen meanwhile. */

import { beforeEach, expect, test } from "vitest";

import { Exposure } from "../src/exposure";
import { FakeHost, plain, type Asked } from "./fake-host";

const FULL = { maxWidth: 20, maxHeight: 20, samples: 4 };
const DRAFT = { maxWidth: 2, maxHeight: 2, samples: 1 };

let host: FakeHost;
let exposure: Exposure;
let finished: number;

beforeEach(() => {
  host = new FakeHost();
  finished = 0;
  exposure = new Exposure("mirage", host, () => undefined, () => finished++);
});

function asked(index: number): Asked {
  const found = host.asked[index];
  if (found === undefined) {
    throw new Error(`there were ${host.asked.length} requests, not ${index + 1}`);
  }
  return found;
}

function red(): number | null {
  const color = exposure.shown?.color(1, 1);
  return color ? Math.round(color[0] * 255) : null;
}

test("the picture grows with its tiles", async () => {
  exposure.request("full", FULL);
  expect(asked(0).request).toEqual({ optics: "mirage", ...FULL });
  expect([exposure.rendering, exposure.progress, red()]).toEqual([true, 0, null]);
  asked(0).tile(plain(10, 2));
  expect([exposure.progress, red()]).toEqual([0.25, 10]);
  asked(0).tile(plain(20));
  await asked(0).answer({ version: 3 });
  expect([exposure.rendering, red(), exposure.answer?.version, finished]).toEqual([false, 20, 3, 1]);
});

test("a draft is ended by nothing: what was asked for meanwhile comes after it, the last only", async () => {
  exposure.request("draft", DRAFT);
  exposure.request("draft", { ...DRAFT, maxWidth: 3 });
  exposure.request("draft", { ...DRAFT, maxWidth: 4 });
  expect(host.asked.length).toBe(1);
  await asked(0).answer({});
  expect(asked(1).request.maxWidth).toBe(4);
  await asked(1).answer({});
  expect(host.asked.length).toBe(2);
});

test("a full picture is ended by the next request, and what comes of it late is not shown", async () => {
  exposure.request("full", FULL);
  asked(0).tile(plain(10, 2));
  exposure.request("draft", DRAFT);
  expect(host.asked.length).toBe(2);
  asked(0).tile(plain(99));
  expect(red()).toBe(10);
  await asked(0).answer({ status: "cancelled" });
  expect(exposure.rendering).toBe(true);
  asked(1).tile(plain(30));
  await asked(1).answer({});
  expect([exposure.rendering, red(), finished]).toEqual([false, 30, 1]);
});

test("the last good picture comes back after an error", async () => {
  exposure.request("full", FULL);
  asked(0).tile(plain(10));
  await asked(0).answer({});
  exposure.request("full", FULL);
  asked(1).tile(plain(20, 2));
  expect(red()).toBe(20);
  await asked(1).answer({ status: "error", message: "no memory" });
  expect([red(), exposure.error]).toEqual([10, "no memory"]);
  exposure.request("full", FULL);
  await asked(2).fail("the language server does not run");
  expect([red(), exposure.error]).toEqual([10, "the language server does not run"]);
  exposure.request("full", FULL);
  asked(3).tile(plain(30));
  await asked(3).answer({});
  expect([red(), exposure.error]).toEqual([30, null]);
});

test("the full size is that of full pictures; it is known whether they would have been larger", async () => {
  exposure.request("full", FULL);
  await asked(0).answer({ width: 20, height: 12 });
  expect(exposure.full).toEqual({ width: 20, height: 12, aspect: 1, limited: true });
  exposure.request("draft", DRAFT);
  await asked(1).answer({ width: 2, height: 1 });
  expect(exposure.full).toEqual({ width: 20, height: 12, aspect: 1, limited: true });
  exposure.request("full", FULL);
  await asked(2).answer({ width: 8, height: 8 });
  expect(exposure.full?.limited).toBe(false);
});

test("another scene begins with nothing", async () => {
  exposure.request("full", FULL);
  asked(0).tile(plain(10));
  exposure.clear();
  await asked(0).answer({});
  expect([exposure.shown, exposure.answer, exposure.rendering, finished]).toEqual([null, null, false, 0]);
});
