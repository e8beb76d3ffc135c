// Clearances, gaps and solids, against distances known from geometry.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { Hausdorff } from "nurbs-hausdorff";
import { Hausdorff as WorkerHausdorff } from "nurbs-hausdorff/worker";

const hd = await Hausdorff.create({ backend: "cpu" });
const ball = hd.shape("sphere"); // radius 2
const small = hd.shape("sphere-small"); // radius 0.2
after(() => {
  for (const owner of [ball, small, hd]) owner.dispose();
});

const at = (x) => ({ transform: { translation: [x, 0, 0] } });

test("the clearance of spheres is that of their centres and radii", async () => {
  for (const [x, truth, kind] of [
    [5, 2.8, "none"],
    [2, 0, "intersecting"],
    [1, 0.8, "contained"],
  ]) {
    const found = await hd.clearance(small, ball, at(x));
    assert.ok(found.converged && found.lower <= truth && truth <= found.upper, `${x}`);
    assert.ok(found.upper - found.lower <= found.tolerance);
    assert.equal(found.overlap.kind, kind);
    if ("insideBoth" in found.overlap) assert.ok(Math.hypot(...found.overlap.insideBoth) < 2);
  }
});

test("a limit is decided, and solids that overlap have no clearance", async () => {
  for (const [x, limit, atLeast] of [
    [5, 2.7, true],
    [5, 2.9, false],
    [1, 0.5, false],
  ]) {
    assert.equal((await hd.clearance(small, ball, { ...at(x), limit })).atLeast, atLeast);
  }
});

test("gaps are listed below a distance, and options are checked", async () => {
  assert.equal((await hd.gaps(small, ball, { ...at(5), below: 2.7 })).pairs.length, 0);
  const { pairs, complete } = await hd.gaps(small, ball, { ...at(5), below: 2.9 });
  assert.ok(complete && pairs.length === 1 && pairs[0].lower <= 2.8 && 2.8 <= pairs[0].upper);
  await assert.rejects(hd.gaps(small, ball, { below: -1 }), { code: "OPTION_OUT_OF_RANGE" });
  await assert.rejects(hd.clearance(small, ball, { below: 1 }), { code: "OPTION_INVALID" });
});

test("a closed model is a solid, and its signs are those of the solid", async () => {
  assert.deepEqual(ball.solid(), {
    closed: true,
    shells: [{ faces: [0], closed: true }],
    freeEdges: [],
  });
  const { signed, signs } = await hd.closestPoints(ball, [0, 0, 1, 0, 0, 3]);
  assert.equal(signs, "solid");
  assert.ok(Math.abs(signed[0] + 1) < 1e-8 && Math.abs(signed[1] - 1) < 1e-8);
  const sheet = hd.shape("fig5-plane");
  assert.ok(!sheet.solid().closed && sheet.solid().freeEdges.length > 0);
  sheet.dispose();
});

test("the worker answers the same", async () => {
  const there = await WorkerHausdorff.create({ backend: "cpu" });
  const [a, b] = [await there.shape("sphere-small"), await there.shape("sphere")];
  const found = await there.clearance(a, b, at(5));
  assert.ok(found.lower <= 2.8 && 2.8 <= found.upper);
  assert.ok((await b.solid()).closed);
  assert.equal((await there.gaps(a, b, { ...at(5), below: 2.9 })).pairs.length, 1);
  there.dispose();
});
