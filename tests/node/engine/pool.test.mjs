// Workers beside the first of `nurbs-hausdorff/worker`: they share points out, and change no bit of a result.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Hausdorff } from "nurbs-hausdorff/worker";
import { stepSquares } from "../../page/support/models.mjs";
import { square, withCode } from "../support.mjs";

/** Numbers of workers. */
const SIZES = [1, 2, 3];
/** Some blocks of points, and no multiple of one: more than the making of a model takes. */
const COUNT = 6000;

let pools;
before(async () => {
  pools = await Promise.all(SIZES.map((workers) => Hausdorff.create({ backend: "cpu", workers })));
});
after(() => {
  for (const hd of pools) hd.dispose();
});

/** Points spread over a box by multiples of irrational numbers. */
function spread({ min, max }, count = COUNT) {
  const steps = [0.7548776662466927, 0.5698402909980532, 0.3819660112501052];
  return Float64Array.from({ length: 3 * count }, (_, at) => {
    const part = (Math.floor(at / 3) * steps[at % 3]) % 1;
    return min[at % 3] + part * (max[at % 3] - min[at % 3]);
  });
}

/** A ball as a mesh. */
function ball(rings = 12) {
  const positions = [];
  const triangles = [];
  for (let ring = 0; ring <= rings; ring++) {
    for (let step = 0; step < 2 * rings; step++) {
      const [polar, around] = [(Math.PI * ring) / rings, (Math.PI * step) / rings];
      const out = Math.sin(polar);
      positions.push(out * Math.cos(around), out * Math.sin(around), Math.cos(polar));
      const next = (step + 1) % (2 * rings);
      const [a, b] = [2 * rings * ring + step, 2 * rings * ring + next];
      if (ring < rings) triangles.push(a, a + 2 * rings, b, b, a + 2 * rings, b + 2 * rings);
    }
  }
  return { positions, triangles };
}

const MODELS = {
  "a NURBS model": (hd) => hd.shape("torus"),
  "trimmed faces of a file": (hd) => hd.readCad(new TextEncoder().encode(stepSquares(2))),
  "a mesh": (hd) => hd.mesh(ball()),
};

/** Results compare equal only if no bit differs: -0 is not 0, and NaN is itself. */
const same = (found, expected) => assert.deepStrictEqual(found, expected);

for (const [what, make] of Object.entries(MODELS)) {
  test(`closest points of ${what} are those of one worker`, async () => {
    let expected;
    for (const hd of pools) {
      const model = await make(hd);
      const fractions = [];
      const found = await hd.closestPoints(model, spread(model.boundingBox), {
        ...{ transform: { translation: [0.1, 0, 0] }, relativeTolerance: 1e-6 },
        onProgress: (fraction) => fractions.push(fraction),
      });
      expected ??= found;
      same(found, expected);
      assert.equal(fractions.at(-1), 1);
      assert.ok(fractions.every((fraction, k) => k === 0 || fraction >= fractions[k - 1]));
      model.dispose();
    }
  });
}

test("maps of both models are those of one worker, coarse ones too", async () => {
  const found = [];
  for (const hd of pools.slice(0, 2)) {
    const pair = await Promise.all(["sphere", "torus"].map((name) => hd.shape(name)));
    const [coarse, fractions] = [[], []];
    const maps = await hd.deviationMaps(...pair, {
      ...{ a: {}, b: {}, transform: { translation: [0.1, 0, 0] } },
      onCoarse: (some) => coarse.push(some),
      onProgress: (fraction) => fractions.push(fraction),
    });
    assert.equal(coarse.length, 1);
    assert.equal(fractions.at(-1), 1);
    found.push({ maps, coarse });
  }
  for (const other of found) same(other, found[0]);
});

test("signed distances on a grid are those of one worker", async () => {
  for (const options of [{ resolution: 20 }, { resolution: 30, band: 0.1, precision: "float32" }]) {
    let expected;
    for (const hd of pools) {
      const model = await hd.mesh(ball());
      const fractions = [];
      const onProgress = (fraction) => fractions.push(fraction);
      const found = await hd.signedDistances(model, { ...options, onProgress });
      expected ??= found;
      same(found, expected);
      assert.equal(fractions.at(-1), 1);
      model.dispose();
    }
  }
});

test("a model that was updated is measured as it is, and one disposed of while it is measured too", async () => {
  const found = [];
  for (const hd of pools) {
    const model = await hd.model([square(0)]);
    const points = spread({ min: [-1, -1, 2], max: [2, 2, 3] });
    const before = hd.closestPoints(model, points);
    const raised = [0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1.5, 1];
    await model.update(0, raised);
    const after = hd.closestPoints(model, points);
    model.dispose();
    found.push([await before, await after]);
  }
  for (const other of found) same(other, found[0]);
  const [[before, after]] = found;
  assert.ok(Math.min(...before.distances) >= 2 && Math.min(...after.distances) < 2);
});

test("a signal ends the work of all workers, which go on", async () => {
  const hd = pools[2];
  const model = await hd.shape("torus");
  const points = spread(model.boundingBox);
  const reason = new Error("enough");
  const controller = new AbortController();
  const work = hd.closestPoints(model, points, {
    signal: controller.signal,
    onProgress: () => controller.abort(reason),
  });
  await assert.rejects(work, (error) => withCode("CANCELLED")(error) && error.cause === reason);
  const thrown = new RangeError("from the callback");
  const throwing = () => {
    throw thrown;
  };
  await assert.rejects(
    hd.closestPoints(model, points, { onProgress: throwing }),
    (error) => error === thrown,
  );
  const pair = [model, await hd.shape("sphere")];
  const stop = new AbortController();
  const onProgress = () => stop.abort();
  await assert.rejects(
    hd.deviationMaps(...pair, { onProgress, signal: stop.signal }),
    withCode("CANCELLED"),
  );
  const { distances } = await hd.closestPoints(model, points);
  assert.equal(distances.length, COUNT);
});

test("errors are those of one worker", async () => {
  const wrong = spread({ min: [0, 0, 0], max: [1, 1, 1] });
  wrong[3 * 4321 + 1] = Number.NaN;
  for (const hd of pools) {
    const model = await hd.shape("torus");
    await assert.rejects(
      hd.closestPoints(model, wrong),
      withCode("POINT_OUT_OF_RANGE", /point 4321 /),
    );
    const points = spread(model.boundingBox);
    const options = { tolerance: -1 };
    await assert.rejects(hd.closestPoints(model, points, options), withCode("OPTION_OUT_OF_RANGE"));
    await assert.rejects(
      hd.closestPoints(model, points, { tolerances: 1 }),
      withCode("OPTION_INVALID", /tolerance/),
    );
    const open = await hd.model([square()]);
    await assert.rejects(hd.signedDistances(open), withCode("NOT_CLOSED", /4 free edges/));
    assert.equal((await hd.closestPoints(model, [])).distances.length, 0);
  }
});

test("a memory budget that holds one copy of the models leaves one worker", async () => {
  // The module itself has more than a MiB.
  const hd = await Hausdorff.create({ backend: "cpu", workers: 3, memoryBudget: 1 });
  const model = await hd.shape("torus");
  const points = spread(model.boundingBox);
  const found = await hd.closestPoints(model, points);
  assert.equal(hd.workers, 1);
  same(found, await pools[1].closestPoints(await pools[1].shape("torus"), points));
  hd.dispose();
});

test("few points start no worker", async () => {
  const hd = await Hausdorff.create({ backend: "cpu", workers: "auto" });
  const model = await hd.shape("torus");
  await hd.closestPoints(model, spread(model.boundingBox, 100));
  assert.equal(hd.workers, 1);
  hd.dispose();
});

test("many points start workers, with a model that is quickly made", async () => {
  for (const [at, hd] of pools.entries()) {
    const model = await hd.shape("torus");
    await hd.closestPoints(model, spread(model.boundingBox, 30_000));
    assert.equal(hd.workers, SIZES[at]);
  }
});

test("wrong options are refused", async () => {
  for (const workers of [0, -1, 1.5, 65, Number.NaN]) {
    await assert.rejects(Hausdorff.create({ workers }), withCode("OPTION_OUT_OF_RANGE", /workers/));
  }
  await assert.rejects(Hausdorff.create({ workers: "all" }), withCode("OPTION_INVALID", /"all"/));
  await assert.rejects(
    Hausdorff.create({ workers: 2, memoryBudget: 0 }),
    withCode("OPTION_OUT_OF_RANGE", /memoryBudget/),
  );
});
