// The entry `nurbs-hausdorff/worker`: the same answers, from another thread.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import * as plain from "nurbs-hausdorff";
import { Hausdorff, NurbsModel } from "nurbs-hausdorff/worker";
import { createBoth, givesWay, interchangeSquare, square, withCode } from "../support.mjs";

let hd;
let direct;
before(async () => {
  [hd, direct] = await createBoth(Hausdorff);
});
after(() => {
  hd.dispose();
  direct.dispose();
});

/** The result without its times. */
const timeless = ({ seconds: _, forward, reverse, ...rest }) => ({
  ...rest,
  ...(forward && { forward: timeless(forward), reverse: timeless(reverse) }),
});

test("both entries have the same methods", () => {
  const methods = (type) => Object.getOwnPropertyNames(type.prototype).sort();
  const internal = new Set([
    ...["closestPointsOfBlock", "deviationMapsBy", "layersOfGrid", "signedDistancesOfLayer"],
    ...["held", "prepared", "source", "whenFree"],
  ]);
  const [ours, theirs] = [methods(Hausdorff), methods(plain.Hausdorff)];
  // The static `shapes` is a method here, as the module is the worker's.
  const shared = theirs.filter((name) => !internal.has(name));
  assert.deepEqual(ours, [...shared, "shapes", "workers"].sort());
  const models = methods(plain.NurbsModel).filter((name) => !internal.has(name));
  assert.deepEqual(methods(NurbsModel), models);
  assert.equal(hd.backend, "cpu");
  assert.equal(hd.adapter, null);
  assert.equal(hd.notice, null);
});

test("a field is that of the main entry", async () => {
  const names = ["torus", "sphere"];
  const far = await Promise.all(names.map((name) => hd.shape(name)));
  const near = names.map((name) => direct.shape(name));
  const options = { samples: 7, transform: { translation: [0, 0, 1] } };
  assert.deepEqual(await hd.field(...far, options), await direct.field(...near, options));
  for (const model of [...far, ...near]) model.dispose();
});

for (const options of [
  { symmetric: true },
  { method: "iteration", samples: 12, deviations: true },
  { method: "hierarchy", grid: 8, transform: { translation: [0, 0, 1] } },
]) {
  test(`a distance by ${options.method ?? "certified"} is that of the main entry`, async () => {
    const names = ["torus", "sphere"];
    const far = await Promise.all(names.map((name) => hd.shape(name)));
    const near = names.map((name) => direct.shape(name));
    assert.deepEqual(
      timeless(await hd.distance(...far, options)),
      timeless(await direct.distance(...near, options)),
    );
    for (const model of [...far, ...near]) model.dispose();
  });
}

test("models of arrays, JSON and text, faces and triangles", async () => {
  const inputs = [[square(0)], interchangeSquare(1), JSON.stringify(interchangeSquare(2))];
  const [a, b, c] = await Promise.all(inputs.map((input) => hd.model(input)));
  assert.deepEqual(c.boundingBox, { min: [0, 0, 2], max: [1, 1, 2] });
  assert.equal(c.name, "square");
  assert.equal(b.faceCount, 1);
  const { state } = await hd.diff(a, b);
  assert.equal(state, "changed");
  const area = await a.area();
  assert.ok(area.lower <= 1 && 1 <= area.upper && area.faces.length === 1);
  const { positions, indices } = await a.tessellate({ tolerance: 0.1 });
  assert.ok(positions instanceof Float32Array && indices.length >= 6);
  const shapes = await hd.shapes();
  assert.deepEqual(shapes, plain.Hausdorff.shapes());
});

test("a best fit is that of the main entry, with its progress", async () => {
  const [far, near] = [await hd.shape("wavy-sheet"), direct.shape("wavy-sheet")];
  const options = { samples: 8, transform: { translation: [0.01, 0, 0.02] } };
  const steps = [];
  const onProgress = (step, rms) => steps.push([step, rms]);
  const found = await hd.bestFit(far, far, { ...options, onProgress });
  assert.deepEqual(found, await direct.bestFit(near, near, options));
  const taken = steps.filter(([step]) => step > 0);
  assert.ok(taken.length > 0 && taken.every(([, rms]) => rms >= 0));
});

test("a cancelled search rejects with the interval that it reached", async () => {
  const [a, b] = await Promise.all(
    ["wigley-hull", "wigley-hull-wider"].map((name) => hd.shape(name)),
  );
  const { lower, upper } = await hd.distance(a, b, { relativeTolerance: 1e-4 });
  const controller = new AbortController();
  const work = hd.distance(a, b, {
    ...{ relativeTolerance: 1e-13, signal: controller.signal },
    onProgress: (fraction) => fraction > 0 && controller.abort(),
  });
  await assert.rejects(work, (error) => {
    assert.ok(error.interval[0] <= upper && lower <= error.interval[1]);
    return withCode("CANCELLED")(error);
  });
});

test("points are copied, or transferred on request", async () => {
  const model = await hd.model([square(0)]);
  const points = new Float64Array([0.5, 0.5, 3]);
  const { distances } = await hd.closestPoints(model, points);
  assert.deepEqual([...distances], [3]);
  assert.equal(points.length, 3);
  await hd.closestPoints(model, points, { transfer: true });
  assert.equal(points.length, 0);
  const list = [0.5, 0.5, 2];
  assert.deepEqual([...(await hd.closestPoints(model, list)).distances], [2]);
});

test("progress arrives, and a signal cancels", async () => {
  const [a, b] = await Promise.all(["wavy-sheet", "wavy-sheet-b"].map((name) => hd.shape(name)));
  const seen = [];
  const options = { method: "iteration", samples: 256, onProgress: (f) => seen.push(f) };
  await hd.distance(a, b, options);
  assert.ok(seen.length > 1 && seen.at(-1) === 1);
  const controller = new AbortController();
  const reason = new Error("enough");
  const long = hd.distance(a, b, {
    ...{ method: "iteration", samples: 512, culling: "none", signal: controller.signal },
    onProgress: (fraction) => fraction > 0 && controller.abort(reason),
  });
  await assert.rejects(long, (error) => {
    assert.equal(error.cause, reason);
    return withCode("CANCELLED")(error);
  });
  await assert.rejects(
    hd.distance(a, b, { signal: AbortSignal.abort(reason) }),
    withCode("CANCELLED"),
  );
  const thrown = new RangeError("from the callback");
  const throwing = () => {
    throw thrown;
  };
  await assert.rejects(hd.distance(a, b, { onProgress: throwing }), (error) => error === thrown);
});

test("errors keep their codes", async () => {
  const model = await hd.shape("sphere");
  await assert.rejects(hd.shape("cube"), withCode("UNKNOWN_SHAPE", /sphere/));
  await assert.rejects(hd.model([{ ...square(), degree: 1 }]), withCode("ARGUMENT_INVALID"));
  await assert.rejects(
    hd.distance(model, model, { samples: 0, method: "iteration" }),
    withCode("OPTION_OUT_OF_RANGE"),
  );
  await assert.rejects(hd.distance(model, {}), withCode("ARGUMENT_INVALID", /b is not/));
  await assert.rejects(hd.model([{ degree: () => 1 }]), withCode("ARGUMENT_INVALID", /clone/));
  const other = await Hausdorff.create({ backend: "cpu" });
  await assert.rejects(
    other.distance(model, model),
    withCode("ARGUMENT_INVALID", /another worker/),
  );
  other.dispose();
  model.dispose();
  await assert.rejects(hd.distance(model, model), withCode("DISPOSED"));
  await assert.rejects(
    Hausdorff.create({ wrokers: 2 }),
    withCode("OPTION_INVALID", /"wrokers".*workers/),
  );
  await assert.rejects(
    Hausdorff.create({ module: new Uint8Array([0, 1]) }),
    withCode("MODULE_FAILED"),
  );
});

test("work that was begun ends well after dispose, nothing begins", async () => {
  const own = await Hausdorff.create({ backend: "cpu" });
  const [a, b] = await Promise.all(["sphere", "sphere-larger"].map((name) => own.shape(name)));
  const begun = own.distance(a, b);
  own.dispose();
  assert.ok(Math.abs((await begun).upper - 0.2) < 1e-5);
  await assert.rejects(own.distance(a, b), withCode("DISPOSED"));
  assert.throws(() => own.backend, withCode("DISPOSED"));
});

test("nothing blocks the caller's thread for long", async () => {
  const names = ["wavy-sheet", "wavy-sheet-b"];
  const points = Float64Array.from({ length: 60_000 }, (_, index) => Math.sin(index));
  const work = async () => {
    const [a, b] = await Promise.all(names.map((name) => hd.shape(name)));
    await hd.distance(a, b, { method: "hierarchy" });
    await hd.distance(a, b, { method: "iteration", deviations: true });
    await hd.closestPoints(a, points, { relativeTolerance: 1e-3 });
  };
  await givesWay(work);
});
