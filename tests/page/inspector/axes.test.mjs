// The axes of a section's plot: round coordinates of the models where they are, in the unit shown.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { ticks } = await moduleOf("inspection/cut/axes.ts");

test("ticks are round, stand where they say, and are no nearer than asked for", () => {
  for (const [from, to, origin, apart] of [
    [-5, 5, 100, 1.2],
    [-0.003, 0.002, 0, 0.0004],
    [0, 1, -0.75, 0.1],
    [-2000, 3000, 12.5, 900],
  ]) {
    const found = ticks([from, to], origin, apart);
    assert.ok(found.length >= 2, `${from} ${to}: ${found.length}`);
    for (const [index, { at, text }] of found.entries()) {
      const value = Number(text.replace("−", "-"));
      assert.ok(Math.abs(value - at - origin) < 1e-9 * (to - from), `${text} at ${at}`);
      assert.ok(from - 1e-9 <= at && at <= to + 1e-9, `${text} in the plot`);
      if (index > 0) assert.ok(at - found[index - 1].at >= apart * (1 - 1e-9), `${text} apart`);
      assert.match(text, /^−?\d+(\.\d+)?$/);
    }
  }
  assert.deepEqual(
    ticks([0, 1], -0.5, 0.4).map(({ text }) => text),
    ["−0.5", "0.0", "0.5"],
  );
});

test("a plot of no size has no ticks", () => {
  assert.deepEqual(ticks([1, 1], 0, 1), []);
  assert.deepEqual(ticks([0, 1], 0, 0), []);
});
