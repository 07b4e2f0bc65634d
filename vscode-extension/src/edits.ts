/**
 * Follows places through edits, so that what was told of an older version of a text is found in the one of now. The
 * server's answers hold for the text as it stands; this is for what is kept of them while one types on.
 *
 * A place within what was replaced goes to its beginning. Positions are lines and characters, from 0.
 */

export interface Place {
  line: number;
  character: number;
}

export interface Span {
  start: Place;
  end: Place;
}

/** A replacement; all of one edit count in the text before it. */
export interface Change {
  range: Span;
  text: string;
}

interface Step {
  /** The version that the text has after it. */
  version: number;
  /** What was replaced and what stands there instead, the last in the text first. */
  moves: { old: Span; new: Span }[];
}

const MOST_STEPS = 2000;

export class Edits {
  private steps: Step[] = [];

  add(version: number, changes: readonly Change[]): void {
    const ordered = [...changes].sort((one, other) => compare(other.range.start, one.range.start));
    const moves = ordered.map(({ range, text }) => ({
      old: { start: { ...range.start }, end: { ...range.end } },
      new: { start: { ...range.start }, end: after(range.start, text) },
    }));
    this.steps.push({ version, moves });
    if (this.steps.length > MOST_STEPS) {
      this.steps = this.steps.slice(-MOST_STEPS / 2);
    }
  }

  /** Where a place of an older version is now. */
  toNow(version: number, place: Place): Place {
    let at = place;
    for (const step of this.steps.filter((step) => step.version > version)) {
      for (const move of step.moves) {
        at = moved(at, move.old, move.new);
      }
    }
    return at;
  }

  /** Where a place of now was in an older version. */
  toThen(version: number, place: Place): Place {
    let at = place;
    for (const step of this.steps.filter((step) => step.version > version).reverse()) {
      for (const move of [...step.moves].reverse()) {
        at = moved(at, move.new, move.old);
      }
    }
    return at;
  }
}

function moved(place: Place, from: Span, to: Span): Place {
  if (compare(place, from.start) <= 0) {
    return place;
  }
  if (compare(place, from.end) < 0) {
    return from.start;
  }
  const character = place.line === from.end.line ? place.character - from.end.character + to.end.character : null;
  return { line: place.line - from.end.line + to.end.line, character: character ?? place.character };
}

function compare(one: Place, other: Place): number {
  return one.line - other.line || one.character - other.character;
}

/** Where a text ends that begins at a place. */
function after(start: Place, text: string): Place {
  const lines = text.split(/\r\n|\r|\n/);
  const last = lines[lines.length - 1] ?? "";
  const character = lines.length === 1 ? start.character + last.length : last.length;
  return { line: start.line + lines.length - 1, character };
}
