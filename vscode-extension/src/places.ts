/** Which of many places holds a position: the narrowest. */

import type { Place, Span } from "./edits";

/** The index of the narrowest range that holds the position; -1: none does. Of equals it is the first. */
export function narrowest(ranges: readonly (Span | null | undefined)[], at: Place): number {
  let best = -1;
  let found: Span | null = null;
  for (const [index, range] of ranges.entries()) {
    if (range && holds(range, at) && (found === null || isNarrower(range, found))) {
      best = index;
      found = range;
    }
  }
  return best;
}

export function holds(range: Span, at: Place): boolean {
  return !isBefore(at, range.start) && !isBefore(range.end, at);
}

export function same(one: Span | null | undefined, other: Span | null | undefined): boolean {
  if (!one || !other) {
    return !one && !other;
  }
  return !isBefore(one.start, other.start) && !isBefore(other.start, one.start) && sameEnd(one, other);
}

function sameEnd(one: Span, other: Span): boolean {
  return one.end.line === other.end.line && one.end.character === other.end.character;
}

function isBefore(one: Place, other: Place): boolean {
  return one.line < other.line || (one.line === other.line && one.character < other.character);
}

/** Fewer lines, or on as many lines fewer characters. */
function isNarrower(one: Span, other: Span): boolean {
  const lines = (range: Span): number => range.end.line - range.start.line;
  const characters = (range: Span): number => range.end.character - range.start.character;
  return lines(one) < lines(other) || (lines(one) === lines(other) && characters(one) < characters(other));
}
