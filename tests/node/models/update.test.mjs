// New control points on the same knots.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import * as away from "nurbs-hausdorff/worker";
import { create, near, square, withCode } from "../support.mjs";

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd.dispose());

const points = (z) => square(z).controlPoints;

test("an updated model is measured with its new control points", async () => {
  const [moving, fixed] = [hd.model([square(1), square(2)]), hd.model([square(0)])];
  near((await hd.distance(moving, fixed)).upper, 2, 1e-5);
  for (const z of [3, 4, 0.5]) {
    moving.update(1, points(z));
    near((await hd.distance(moving, fixed)).upper, Math.max(1, z), 1e-5);
    assert.equal(moving.boundingBox.max[2], Math.max(1, z));
  }
  const doubled = points(7).map((number) => 2 * number);
  moving.update(0, Float32Array.from(doubled), { homogeneous: true });
  near((await hd.distance(moving, fixed)).upper, 7, 1e-5);
  moving.dispose();
  fixed.dispose();
});

test("a distance that was begun measures the control points of its beginning", async () => {
  const [moving, fixed] = [hd.model([square(1)]), hd.model([square(0)])];
  const begun = hd.distance(moving, fixed);
  moving.update(0, points(5));
  near((await begun).upper, 1, 1e-5);
  near((await hd.distance(moving, fixed)).upper, 5, 1e-5);
});

test("wrong control points are refused, and change nothing", async () => {
  const [moving, fixed] = [hd.model([square(1)]), hd.model([square(0)])];
  assert.throws(() => moving.update(0, points(5).slice(4)), withCode("RAGGED_NET"));
  assert.throws(() => moving.update(0, [1, 2, 3]), withCode("ARGUMENT_INVALID", /four a point/));
  assert.throws(() => moving.update(1, points(5)), withCode("OPTION_OUT_OF_RANGE", /surface/));
  assert.throws(() => moving.update(-1, points(5)), withCode("ARGUMENT_INVALID"));
  assert.throws(() => moving.update(0, points(Number.NaN)), withCode("NON_FINITE"));
  near((await hd.distance(moving, fixed)).upper, 1, 1e-5);
  moving.dispose();
  assert.throws(() => moving.update(0, points(5)), withCode("DISPOSED"));
});

test("in a worker, calls after an update use the new control points", async () => {
  const own = await away.Hausdorff.create({ backend: "cpu" });
  const [moving, fixed] = await Promise.all([own.model([square(1)]), own.model([square(0)])]);
  const updated = moving.update(0, points(5));
  near((await own.distance(moving, fixed)).upper, 5, 1e-5);
  await updated;
  assert.equal(moving.boundingBox.max[2], 5);
  own.dispose();
});
