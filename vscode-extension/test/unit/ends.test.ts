/** A server that ends now and then is started again; one that keeps ending is not. */

import { expect, test } from "vitest";

import { Ends, MOST_ENDS } from "../../src/ends";

test("after too many ends in a short time it is left alone", () => {
  const ends = new Ends();
  const again = Array.from({ length: MOST_ENDS + 1 }, (_, index) => ends.add(index * 1000));
  expect(again).toEqual([...Array<boolean>(MOST_ENDS).fill(true), false]);
  expect(ends.count).toBe(MOST_ENDS + 1);
});

test("what is long ago does not count", () => {
  const ends = new Ends();
  for (let end = 0; end < 20; end++) {
    expect(ends.add(end * 60_000)).toBe(true);
  }
});

test("when a person starts it, it begins anew", () => {
  const ends = new Ends();
  for (let end = 0; end < MOST_ENDS; end++) {
    ends.add(end);
  }
  ends.forget();
  expect(ends.add(MOST_ENDS)).toBe(true);
});
