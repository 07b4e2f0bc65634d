/** The time from a key to what it changes in the diagnostics, as a person sees it: in the page. */

import type { Workbench } from "./workbench";

const ROUNDS = 15;

declare global {
  interface Window {
    watched: Promise<number>;
  }
}

/** Makes an error and mends it, again and again: the times in ms from the key until the squiggle is there. */
export async function latencies(workbench: Workbench, name: string): Promise<number[]> {
  const { page } = workbench;
  const editor = workbench.editor(name);
  await workbench.goTo(name, "SEGMENTS 300");
  await editor.locator(".squiggly-error").first().waitFor({ state: "detached" });
  const times: number[] = [];
  for (let round = 0; round < ROUNDS; round++) {
    await page.evaluate(watch, true);
    await page.keyboard.type("x");
    times.push(await page.evaluate(() => window.watched));
    await page.evaluate(watch, false);
    await page.keyboard.press("Backspace");
    await page.evaluate(() => window.watched);
  }
  return times;
}

export function median(values: number[]): number {
  const sorted = [...values].sort((one, other) => one - other);
  return sorted[Math.floor(sorted.length / 2)] ?? NaN;
}

/** Runs in the page; then `watched` is the time from the next key until there is, or is no longer, a squiggle. */
function watch(appears: boolean): void {
  window.watched = new Promise((resolve) => {
    let pressed = NaN;
    window.addEventListener("keydown", () => (pressed = performance.now()), { capture: true, once: true });
    const look = (): void => {
      if (!Number.isNaN(pressed) && (document.querySelector(".squiggly-error") !== null) === appears) {
        resolve(performance.now() - pressed);
      } else {
        requestAnimationFrame(look);
      }
    };
    requestAnimationFrame(look);
  });
}
