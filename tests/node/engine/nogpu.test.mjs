// The package in plain Node, where nothing provides WebGPU.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Hausdorff, HausdorffError } from "nurbs-hausdorff";

test("auto computes on the CPU and says why", async () => {
  const hd = await Hausdorff.create();
  assert.equal(hd.backend, "cpu");
  assert.match(hd.notice, /navigator\.gpu/);
  const [small, large] = ["sphere", "sphere-larger"].map((name) => hd.shape(name));
  const { lower, upper, backend } = await hd.distance(small, large);
  assert.equal(backend, "cpu");
  assert.ok(lower <= 0.2 + 1e-12 && 0.2 - 1e-12 <= upper && upper - lower < 1e-5);
});

test("a GPU that is required is refused with its code", async () => {
  await assert.rejects(Hausdorff.create({ backend: "gpu" }), (error) => {
    assert.ok(error instanceof HausdorffError);
    assert.equal(error.code, "NO_ADAPTER");
    return true;
  });
});
