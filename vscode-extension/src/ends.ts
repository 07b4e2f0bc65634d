/** How often the language server has ended by itself of late: one that keeps ending is not started again and again. */

/** One that ends so often within so many ms is not started again by itself. */
export const MOST_ENDS = 4;
const WITHIN = 180_000;

export class Ends {
  private times: number[] = [];

  /** It has ended once more. Whether it is to be started again. */
  add(now: number): boolean {
    this.times = [...this.times.filter((time) => now - time < WITHIN), now];
    return this.times.length <= MOST_ENDS;
  }

  /** A person wants it started: what was before counts no longer. */
  forget(): void {
    this.times = [];
  }

  get count(): number {
    return this.times.length;
  }
}
