import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, near, square } from "../support.mjs";

/** The largest difference of both backends, relative to the diagonal. */
const agreement = 1e-5;

let hd;
before(async () => {
  hd = await create();
});
after(() => hd.dispose());

const iteration = { method: "iteration", samples: 24 };

test("parallel squares are their offset apart", async () => {
  const a = hd.model([square(0)]);
  const b = hd.model([square(0.25)]);
  const result = await hd.distance(a, b, iteration);
  assert.equal(result.method, "iteration");
  assert.equal(result.backend, "gpu");
  assert.match(result.adapter, /llvmpipe/);
  near(result.computed, 0.25, 1e-12);
  assert.ok(result.lower <= 0.25 && 0.25 <= result.upper);
  assert.equal(result.samples, 24 * 24);
  assert.equal(result.diagonal, Math.SQRT2);
  assert.deepEqual(result.patches, { a: 1, b: 1 });
  assert.equal(result.witness.a.point[2], 0);
  assert.equal(result.witness.b.point[2], 0.25);
  assert.equal(result.forward, undefined);
  assert.equal(result.deviations, undefined);
});

for (const [nameA, nameB] of [
  ["sphere", "torus"],
  ["naca-wing", "naca-wing-thicker"],
  ["wavy-sheet", "wavy-sheet-b"],
  ["cylinder", "cone"],
]) {
  test(`GPU and CPU agree on ${nameA} against ${nameB}`, async () => {
    const a = hd.shape(nameA);
    const b = hd.shape(nameB);
    const [gpu, cpu] = await Promise.all([
      hd.distance(a, b, { ...iteration, backend: "gpu" }),
      hd.distance(a, b, { ...iteration, backend: "cpu" }),
    ]);
    assert.equal(gpu.backend, "gpu");
    assert.equal(cpu.backend, "cpu");
    assert.equal(cpu.adapter, null);
    assert.equal(cpu.notice, undefined);
    near(gpu.computed, cpu.computed, agreement * cpu.diagonal);
    near(gpu.bounds.kARigorous, cpu.bounds.kARigorous, agreement * cpu.diagonal);
    for (const { lower, computed, upper } of [gpu, cpu]) {
      assert.ok(lower <= computed && computed <= upper);
    }
  });
}

test("concentric spheres are the difference of their radii apart", async () => {
  const a = hd.shape("sphere");
  const b = hd.shape("sphere-larger");
  for (const method of ["iteration", "certified"]) {
    const result = await hd.distance(a, b, {
      method,
      ...(method === "iteration" && { samples: 16 }),
      relativeTolerance: 1e-3,
      symmetric: true,
    });
    near(result.computed, 0.2, 1e-12);
    assert.ok(result.lower <= 0.2 && 0.2 <= result.upper);
    const { a: from, b: to } = result.witness;
    near(Math.hypot(...from.point), 2, 1e-12);
    near(Math.hypot(...to.point), 2.2, 1e-12);
    near(Math.hypot(...from.point.map((x, axis) => x - to.point[axis])), 0.2, 1e-12);
  }
});

test("the certified interval is as narrow as requested", async () => {
  const a = hd.shape("sphere");
  const b = hd.shape("sphere-larger");
  const intervals = [];
  const result = await hd.distance(a, b, {
    relativeTolerance: 1e-4,
    onProgress: (_, interval) => interval && intervals.push(interval),
  });
  assert.equal(result.method, "certified");
  assert.equal(result.stop, "converged");
  assert.ok(result.upper - result.lower <= 1e-4 * result.diagonal);
  assert.ok(intervals.every(([lower, upper]) => lower <= 0.2 && 0.2 <= upper));
  for (const [limit, within] of [
    [0.1, false],
    [0.3, true],
  ]) {
    assert.equal((await hd.distance(a, b, { limit })).within, within);
  }
});

test("with symmetric the larger direction comes first", async () => {
  // A unit square and one moved by 3 along x, with a second next to it.
  const a = hd.model([square(0)]);
  const b = hd.model([square(0), square(5)]);
  const result = await hd.distance(a, b, { ...iteration, symmetric: true });
  near(result.forward.computed, 0, 1e-12);
  near(result.reverse.computed, 5, 1e-12);
  near(result.computed, 5, 1e-12);
  assert.equal(result.witness.a.point[2], 0);
  assert.equal(result.witness.b.point[2], 5);
  assert.equal(result.samples, 3 * 24 * 24);
});

test("a transform moves A", async () => {
  const a = hd.model([square(0)]);
  const moved = await hd.distance(a, a, { ...iteration, transform: { translation: [0, 0, -2] } });
  near(moved.computed, 2, 1e-12);
  assert.equal(moved.witness.a.point[2], -2);
  // A quarter turn about z takes the unit square to -1 <= x <= 0.
  const half = Math.SQRT1_2;
  const turned = await hd.distance(a, a, {
    ...iteration,
    transform: { rotation: new Float64Array([0, 0, half, half]) },
  });
  near(turned.computed, 1, 1e-12);
  near(turned.witness.a.point[0], -1, 1e-12);
});

test("every sample comes back with field", async () => {
  const a = hd.model([square(0), square(1)]);
  const b = hd.model([square(4)]);
  const result = await hd.distance(a, b, { method: "iteration", samples: 5, deviations: true });
  assert.equal(result.deviations.length, 2);
  result.deviations.forEach((field, index) => {
    assert.equal(field.face, index);
    assert.deepEqual(field.counts, [5, 5]);
    assert.ok(field.points instanceof Float64Array && field.feet instanceof Float64Array);
    assert.equal(field.points.length, 75);
    assert.equal(field.feet.length, 75);
    assert.ok(field.distances instanceof Float64Array);
    assert.equal(field.distances.length, 25);
    for (const distance of field.distances) near(distance, 4 - index, 1e-5);
    assert.ok(field.statuses instanceof Uint8Array);
    assert.equal(field.statuses.length, 25);
    assert.ok(field.statuses.every((status) => status <= 2));
    for (let i = 2; i < 75; i += 3) {
      assert.equal(field.points[i], index);
      assert.equal(field.feet[i], 4);
    }
  });
  const both = await hd.distance(a, b, { ...iteration, symmetric: true, deviations: true });
  assert.equal(both.forward.deviations.length, 2);
  assert.equal(both.reverse.deviations.length, 1);
});

test("every choice of the paper's is taken", async () => {
  const a = hd.shape("sphere");
  const b = hd.shape("sphere-larger");
  for (const options of [
    { culling: "none" },
    { sampling: "arc-length" },
    { flatness: "tight", iterations: 8 },
    { flatness: "curvature" },
    { projection: "tangent-plane", stepTolerance: 1e-6, iterations: 50 },
  ]) {
    const { computed } = await hd.distance(a, b, { method: "iteration", samples: 8, ...options });
    near(computed, 0.2, 1e-3);
  }
});

test("the results are plain data", async () => {
  const a = hd.model([square(0)]);
  const result = await hd.distance(a, a, { ...iteration, symmetric: true, deviations: true });
  assert.deepEqual(structuredClone(result), result);
});
