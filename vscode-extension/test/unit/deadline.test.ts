/** Nothing is waited for without end. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { within } from "../../src/deadline";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

test("what comes in time is handed on, and the clock is stopped", async () => {
  await expect(within(1000, "late", Promise.resolve(7))).resolves.toBe(7);
  await expect(within(1000, "late", Promise.reject(new Error("no")))).rejects.toThrow("no");
  expect(vi.getTimerCount()).toBe(0);
});

test("what never comes is said to be late", async () => {
  const waiting = expect(within(1000, "it has not answered", new Promise(() => undefined))).rejects.toThrow(
    "it has not answered",
  );
  await vi.advanceTimersByTimeAsync(1000);
  await waiting;
});
