/** How well something in the preview stands out: ratios of relative luminances after WCAG, 1 to 21. */

import type { Locator } from "playwright-core";

export interface Contrasts {
  /** Of its text with what it is written on. */
  text: number;
  /** Of the outline of the focus with what is around it. */
  outline: number;
  /** How far that is off its edge, in pixels. */
  offset: number;
}

export function contrasts(of: Locator): Promise<Contrasts> {
  return of.evaluate((element) => {
    const read = (color: string): number[] => (color.match(/[\d.]+/g) ?? []).map(Number);
    /** The first ground that is not to be seen through. */
    const ground = (from: Element | null): number[] => {
      for (let at = from; at !== null; at = at.parentElement) {
        const color = read(getComputedStyle(at).backgroundColor);
        if ((color[3] ?? 1) === 1 && color.length > 0) {
          return color;
        }
      }
      return [255, 255, 255];
    };
    const luminance = (color: number[]): number => {
      const [red = 0, green = 0, blue = 0] = color.map((value) => {
        const part = value / 255;
        return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    };
    const ratio = (one: number[], other: number[]): number => {
      const [dark = 0, light = 0] = [luminance(one), luminance(other)].sort((a, b) => a - b);
      return (light + 0.05) / (dark + 0.05);
    };
    const style = getComputedStyle(element);
    return {
      text: ratio(read(style.color), ground(element)),
      outline: ratio(read(style.outlineColor), ground(element.parentElement)),
      offset: parseFloat(style.outlineOffset),
    };
  });
}
