import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, near, square, withCode } from "../../support.mjs";

let hd;
before(async () => {
  hd = await create();
});
after(() => hd.dispose());

test("points above a square have their feet below them", async () => {
  const model = hd.model([square(1)]);
  const points = new Float32Array([0.25, 0.5, 3, 0.75, 0.5, -1, 4, 0.5, 5]);
  const fractions = [];
  const found = await hd.closestPoints(model, points, { onProgress: (f) => fractions.push(f) });
  assert.ok(found.distances instanceof Float64Array && found.faces instanceof Uint32Array);
  [2, 2, 5].forEach((truth, index) => {
    assert.ok(Math.abs(found.distances[index] - truth) <= found.bounds[index]);
    assert.ok(found.bounds[index] < 1e-8);
  });
  assert.deepEqual([...found.faces], [0, 0, 0]);
  [0.25, 0.5, 1, 0.75, 0.5, 1, 1, 0.5, 1].forEach((truth, index) => {
    near(found.feet[index], truth, 1e-6);
  });
  assert.equal(Math.sign(found.signed[0]), -Math.sign(found.signed[1]));
  assert.equal(fractions.at(-1), 1);
  model.dispose();
});

test("the transform moves the points", async () => {
  const model = hd.model([square(0)]);
  const transform = { translation: [0, 0, 4] };
  const found = await hd.closestPoints(model, [0.5, 0.5, 1], { transform });
  near(found.distances[0], 5, 1e-12);
  assert.equal((await hd.closestPoints(model, [])).distances.length, 0);
  model.dispose();
});

test("distances up to the sign tolerance have the sign 0", async () => {
  const model = hd.model([square(0)]);
  const found = await hd.closestPoints(model, [0.5, 0.5, 0.25, 0.5, 0.5, 0.5], {
    signTolerance: 0.3,
  });
  near(found.distances[0], 0.25, 1e-12);
  assert.equal(found.signed[0], 0);
  near(Math.abs(found.signed[1]), 0.5, 1e-12);
  await assert.rejects(
    hd.closestPoints(model, [0, 0, 1], { signTolerance: -1 }),
    withCode("OPTION_OUT_OF_RANGE", /sign tolerance/),
  );
  model.dispose();
});

test("a GPU is used on request alone", async () => {
  const model = hd.model([square(0)]);
  assert.equal((await hd.closestPoints(model, [0.5, 0.5, 1])).decidedOnGpu, 0);
  const options = { backend: "gpu", relativeTolerance: 1e-4 };
  const located = await hd.closestPoints(model, [0.5, 0.5, 1], options);
  assert.equal(located.decidedOnGpu, 1);
  near(located.distances[0], 1, located.bounds[0]);
  model.dispose();
});

test("wrong points are refused by their index", async () => {
  const model = hd.model([square(0)]);
  const wrong = [0, 0, 0, 1, Number.NaN, 0];
  await assert.rejects(hd.closestPoints(model, wrong), withCode("POINT_OUT_OF_RANGE", /point 1 /));
  await assert.rejects(
    hd.closestPoints(model, [1, 2]),
    withCode("ARGUMENT_INVALID", /2 numbers, not a multiple of 3/),
  );
  await assert.rejects(hd.closestPoints(model, "1"), withCode("ARGUMENT_INVALID", /points/));
  await assert.rejects(hd.closestPoints({}, [1, 2, 3]), withCode("ARGUMENT_INVALID", /model/));
  model.dispose();
});
