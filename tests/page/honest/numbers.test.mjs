// Numbers that stand for certified intervals: none is printed that its interval does not hold.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { attainedText, boundText, certifiedText, heldText, intervalText, listedText } =
  await moduleOf("common/text/numbers.ts");

/** A generator of numbers in [0, 1), the same on every run (Park and Miller's). */
function random(seed) {
  let state = seed;
  return () => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
}

test("an upper bound is rounded up, to the digits of distances beside it", () => {
  const next = random(11);
  for (let index = 0; index < 20_000; index++) {
    const diagonal = 10 ** (8 * next() - 4);
    const bound = diagonal * 10 ** (-7 * next());
    const text = boundText(bound, diagonal);
    const value = Number(text);
    assert.ok(bound <= value, `${text} for ${bound}`);
    assert.ok(value - bound <= Math.max(1.1e-5 * diagonal, 0.11 * bound), `${text} for ${bound}`);
  }
  // A part that a face beside it says to be off by 0.1000 is not off by up to 0.11.
  assert.equal(boundText(0.10006, 60), "0.1001");
  assert.equal(boundText(3e-9, 60), "3.0e-9");
});

test("the number of an interval is in it, whatever its size and width are", () => {
  const next = random(7);
  for (let index = 0; index < 20_000; index++) {
    const diagonal = 10 ** (8 * next() - 4);
    const lower = diagonal * 10 ** (-7 * next());
    const upper = lower + diagonal * 10 ** (-2 - 14 * next());
    const computed = lower + next() * (upper - lower);
    for (const text of [
      certifiedText(computed, [lower, upper], diagonal),
      heldText([lower, upper], diagonal),
    ]) {
      const value = Number(text.replace("≤ ", ""));
      if (text.startsWith("≤")) assert.ok(value >= upper, `${text} for ${lower} ${upper}`);
      else assert.ok(lower <= value && value <= upper, `${text} for ${lower} ${upper}`);
    }
    const [from, to] = JSON.parse(intervalText(lower, upper, diagonal));
    assert.ok(from <= lower && upper <= to, `${from} ${to} for ${lower} ${upper}`);
  }
});

test("a distance that is small beside the models has the digits that its interval holds", () => {
  assert.equal(certifiedText(0.0141421356, [0.014142124, 0.014142241], 2000), "0.0141422");
  assert.equal(certifiedText(0.0141421356, [0.014142131, 0.014142139], 2000), "0.014142136");
});

test("digits are those of the models' size where the interval is narrow, and fewer where it is not", () => {
  assert.equal(certifiedText(0.35, [0.3499999, 0.3500001], 107), "0.350");
  assert.equal(certifiedText(3, [3, 3], 8), "3.00000");
  assert.equal(certifiedText(0.36, [0.31, 0.39], 8), "0.36");
  assert.equal(certifiedText(1 / 3, [1 / 3, 1 / 3], 8), `${1 / 3}`);
});

test("a list has the first of many digits, and says that there are more", () => {
  assert.equal(listedText(2.061552812809, [2.0615528128085, 2.0615528128095], 3.7), "2.06155…");
  assert.equal(listedText(0.35, [0.3499999, 0.3500001], 107), "0.350");
  assert.equal(listedText(1e-12, [0, 1.05e-11], 100), "≤ 1.1e-11");
});

test("a wide interval whose lower end is attained has the number of that end", () => {
  assert.equal(attainedText([0.0101676, 0.53], 90), "0.0102");
  assert.equal(listedText(0.0102, [0.0101676, 0.53], 90), "0.0102");
  assert.equal(attainedText([0.3499999, 0.3500001], 107), "0.350");
});

test("an interval that reaches down to nothing states an upper bound", () => {
  assert.equal(certifiedText(1e-12, [0, 1.05e-11], 100), "≤ 1.1e-11");
  assert.equal(certifiedText(0, [0, 0], 100), "0");
});
