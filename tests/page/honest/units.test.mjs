// Lengths in the unit that one likes: every number converted with its interval, and what is typed
// in the unit of the models, which stands beside it.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { moduleOf } from "../support/module.mjs";
import { open } from "../support/open.mjs";

const { certifiedText, intervalText, setShownFactor } = await moduleOf("common/text/numbers.ts");

let opened;
let page;

before(async () => {
  opened = await open({ path: "", unfolded: false });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const text = (selector) => page.locator(selector).textContent();

/** A decimal number as an integer fraction. */
function fraction(number) {
  const [whole, decimals = ""] = number.split(".");
  return [BigInt(whole + decimals), 10n ** BigInt(decimals.length)];
}

/** A float64 as an integer fraction, exactly. */
function exactly(value) {
  let denominator = 1n;
  let scaled = value;
  while (!Number.isInteger(scaled)) {
    scaled *= 2;
    denominator *= 2n;
  }
  return [BigInt(scaled), denominator];
}

/** Whether the first fraction times 127/5 is at most the second: inches in millimetres. */
const inInches = ([p, q], [r, s]) => 127n * p * s <= 5n * q * r;

test("an interval in inches holds the one in millimetres, and its number is in it", () => {
  setShownFactor(0.001 / 0.0254);
  try {
    for (let index = 1; index <= 3000; index++) {
      const lower = index * 0.0137 + 1 / (3 * index);
      const upper = lower + lower * 2 ** -(20 + (index % 25));
      const [from, to] = JSON.parse(
        intervalText(lower, upper, 100).replace(/([\d.]+), ([\d.]+)/, '"$1", "$2"'),
      );
      assert.ok(inInches(fraction(from), exactly(lower)), `${from} for ${lower}`);
      assert.ok(!inInches(fraction(to), exactly(upper)) || to === from, `${to} for ${upper}`);
      const number = Number(certifiedText(lower, [lower, upper], 100).replace("≤ ", ""));
      assert.ok(Math.abs(number * 25.4 - lower) <= upper - lower + 1e-14 * lower, `${number}`);
    }
  } finally {
    setShownFactor(1);
  }
});

test("the card, the legend and the list are in inches, what is typed in millimetres", async () => {
  assert.match(await text("#limit-unit"), /in mm/);
  await opened.until("done", () => page.selectOption("#shown-unit", { label: "in" }));
  assert.equal(await text("#unit"), "in");
  assert.ok(Math.abs(Number(await text("#distance")) - 0.35 / 25.4) < 1e-5);
  assert.match(await text("#compared"), /^> 0\.007874\d*… allowed$/);
  assert.equal(await page.locator("#limit").inputValue(), "0.2");
  assert.match(await text("#limit-unit"), /in mm/);
  assert.match(await text("#legend-title"), /, in/);
  assert.ok(Math.abs(Number((await text("#scale-high")).replace("+", "")) - 0.35 / 25.4) < 1e-5);
  assert.equal(await text("#badge"), "FAIL");
  await page.waitForFunction(() => location.hash.includes("shown-unit=0.0254"));
  await opened.screenshot("inches");
  await opened.until("done", () => page.selectOption("#shown-unit", { label: "mm" }));
  assert.deepEqual([await text("#distance"), await text("#unit")], ["0.350", "mm"]);
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
