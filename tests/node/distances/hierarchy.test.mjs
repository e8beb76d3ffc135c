import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, square, withCode } from "../support.mjs";

const hierarchy = { method: "hierarchy", grid: 16 };

let hd;
before(async () => {
  hd = await create();
});
after(() => hd.dispose());

test("boxes contain the distance of parallel squares", async () => {
  const a = hd.model([square(0)]);
  const b = hd.model([square(0.25)]);
  for (const backend of ["gpu", "cpu"]) {
    const intervals = [];
    const onProgress = (_, interval) => intervals.push(interval);
    const result = await hd.distance(a, b, { ...hierarchy, backend, onProgress });
    assert.equal(result.method, "hierarchy");
    assert.equal(result.backend, backend);
    assert.ok(result.lower <= 0.25 && 0.25 <= result.upper && result.upper < 0.3);
    assert.ok(result.lower <= result.computed && result.computed <= result.upper);
    assert.equal(result.converged, false);
    const { grid, levels, pairs } = result;
    assert.deepEqual([grid, levels, pairs.length, pairs[0]], [16, 5, 5, 1]);
    assert.ok(pairs[4] >= 256);
    assert.deepEqual(intervals.at(-1), [result.lower, result.upper]);
  }
});

test("both directions have pairs, which the whole adds up", async () => {
  const a = hd.shape("sphere");
  const b = hd.shape("torus");
  const options = { ...hierarchy, symmetric: true, transform: { translation: [0, 0, 1] } };
  const { pairs: whole, forward, reverse, lower, upper } = await hd.distance(a, b, options);
  assert.equal(lower, Math.max(forward.lower, reverse.lower));
  assert.equal(upper, Math.max(forward.upper, reverse.upper));
  const sums = forward.pairs.map((pairs, level) => pairs + reverse.pairs[level]);
  assert.deepEqual(whole, sums);
});

test("more pairs than the budget holds are refused by their number", async () => {
  const a = hd.shape("sphere");
  const options = { method: "hierarchy", grid: 128, memoryBudget: 1 };
  const message = /requires \d{6,} pairs of boxes, expected at most 65536/;
  for (const backend of ["gpu", "cpu"]) {
    await assert.rejects(
      hd.distance(a, a, { ...options, backend }),
      withCode("PAIR_BUDGET_EXCEEDED", message),
    );
  }
});

test("an aborted descent is cancelled", async () => {
  const a = hd.shape("sphere");
  const controller = new AbortController();
  const onProgress = () => controller.abort();
  const { signal } = controller;
  await assert.rejects(
    hd.distance(a, a, { method: "hierarchy", signal, onProgress }),
    withCode("CANCELLED"),
  );
});
