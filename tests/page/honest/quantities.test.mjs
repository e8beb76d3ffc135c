// Quantities of any sign and size: no number is printed that its interval does not hold.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { listedQuantity, minus, percentText, quantityText, rangeText, times } = await moduleOf(
  "common/text/quantities.ts",
);

/** A generator of numbers in [0, 1), the same on every run (Park and Miller's). */
function random(seed) {
  let state = seed;
  return () => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
}

const value = (text) => Number(text.replace("−", "-"));

test("the number of an interval is in it, and the interval that is printed contains it", () => {
  const next = random(11);
  for (let index = 0; index < 20_000; index++) {
    const size = 10 ** (30 * next() - 15);
    const middle = size * (2 * next() - 1);
    const width = size * 10 ** (-16 * next());
    const interval = { lower: middle - width * next(), upper: middle + width * next() };
    const { lower, upper } = interval;
    const told = `${lower} ${upper}`;
    const text = quantityText(interval);
    if (text.startsWith("±") || text.startsWith("≤")) {
      assert.ok(value(text.replace(/[±≤ ]/g, "")) >= Math.max(-lower, upper), `${text}: ${told}`);
      assert.ok(lower <= 0 && 0 <= upper, `${text}: ${told}`);
    } else assert.ok(lower <= value(text) && value(text) <= upper, `${text}: ${told}`);
    const ends = rangeText(interval).slice(1, -1).split(", ").map(value);
    assert.ok(ends[0] <= lower && upper <= ends[1], `${ends}: ${told}`);
    const [first, rest] = listedQuantity(interval).split("…");
    assert.ok(text.startsWith(first) && text.endsWith(rest ?? ""), `${first}: ${text}`);
  }
});

test("a number has six digits where its interval is narrow, and fewer where it is not", () => {
  assert.equal(quantityText({ lower: 8, upper: 8 }), "8.00000");
  assert.equal(quantityText({ lower: -19.0000001, upper: -18.9999999 }), "−19.0000");
  assert.equal(quantityText({ lower: 0.31, upper: 0.39 }), "0.35");
  assert.equal(quantityText({ lower: 1.9999999e12, upper: 2.0000001e12 }), "2.00000e+12");
  assert.equal(quantityText({ lower: 0, upper: 0 }), "0");
  assert.equal(quantityText({ lower: -1e-12, upper: 2e-12 }), "±2.0e-12");
});

test("a table has the first of many digits, and says that there are more", () => {
  const third = { lower: 1 / 3, upper: 1 / 3 };
  assert.equal(quantityText(third), `${1 / 3}`);
  assert.equal(listedQuantity(third), "0.333333…");
  const large = { lower: 7654321.12345678, upper: 7654321.1234568 };
  assert.equal(listedQuantity(large), "7654321…");
  assert.equal(listedQuantity({ lower: 8, upper: 8 }), "8.00000");
});

test("differences and products hold every difference and product", () => {
  const next = random(5);
  for (let index = 0; index < 20_000; index++) {
    // Exact in float64: whole numbers below 2^26, whose products are below 2^53.
    const [a, b, c] = [next(), next(), next()].map((one) => Math.floor(one * 2 ** 26));
    const difference = minus({ lower: a, upper: a + 1 }, { lower: b, upper: b + 3 });
    assert.ok(difference.lower <= a - b - 3 && a + 1 - b <= difference.upper);
    const product = times({ lower: a - b, upper: a }, c + 1);
    assert.ok(product.lower <= (a - b) * (c + 1) && a * (c + 1) <= product.upper);
  }
  // 0.1 + 0.2 rounds up: the true difference of the float64 numbers is below what float64 makes of it.
  const { lower, upper } = minus({ lower: 0.1, upper: 0.1 }, { lower: -0.2, upper: -0.2 });
  assert.ok(lower < 0.30000000000000004 && 0.30000000000000004 < upper);
});

test("a change in percent is said where its sign is certain", () => {
  const exact = (value) => ({ lower: value, upper: value });
  assert.equal(percentText(exact(19), exact(8)), "+237.5 %");
  assert.equal(percentText(exact(-2), exact(8)), "−25.0 %");
  assert.equal(percentText({ lower: -1, upper: 2 }, exact(8)), "");
  assert.equal(percentText(exact(1), { lower: 0, upper: 8 }), "");
  assert.equal(percentText({ lower: 1, upper: 2 }, exact(8)), "");
  // 1 of 3, of which the first digits are shown.
  assert.equal(percentText(exact(1), exact(3)), "+33.333… %");
  // The part is between 231 / 60159 and 245 / 60152: no digit behind its first two is certain.
  const text = percentText({ lower: 231, upper: 245 }, { lower: 60152, upper: 60159 });
  const value = Number(text.replace("+", "").replace(" %", ""));
  assert.ok((100 * 231) / 60159 <= value && value <= (100 * 245) / 60152, text);
});
