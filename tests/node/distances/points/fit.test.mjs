// The best fit: known motions are undone, and residuals are those of geometry.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, near, square, withCode } from "../../support.mjs";

let hd;
before(async () => {
  hd = await create();
});
after(() => hd.dispose());

/** The angle of the rotation of a unit quaternion. */
const angleOf = ([x, y, z, w]) => 2 * Math.atan2(Math.hypot(x, y, z), Math.abs(w));

test("a part that a rigid motion moved returns", async () => {
  const part = hd.shape("wavy-sheet");
  const half = 0.05;
  const axis = [2 / 3, -1 / 3, 2 / 3];
  const rotation = [...axis.map((part) => part * Math.sin(half)), Math.cos(half)];
  const transform = { rotation, translation: [0.1, -0.05, 0.08] };
  const steps = [];
  const fit = await hd.bestFit(part, part, {
    transform,
    onProgress: (step, rms, fraction) => {
      assert.ok(fraction >= 0 && fraction <= 1, `${fraction}`);
      // While poses are searched the step is 0.
      if (step === 0) assert.equal(rms, Number.POSITIVE_INFINITY);
      else steps.push([step, rms]);
    },
  });
  assert.ok(fit.converged, JSON.stringify(fit));
  assert.ok(fit.rmsBefore > 0.01, `${fit.rmsBefore}`);
  assert.ok(fit.rms < 1e-8 && fit.steps < 20, JSON.stringify(fit));
  // The sheet lies within 10 units of the origin: angles of 1e-8 and lengths of 1e-7.
  near(angleOf(fit.transform.rotation), 0, 1e-8);
  for (const length of fit.transform.translation) near(length, 0, 1e-7);
  assert.deepEqual(
    steps.map(([step]) => step),
    steps.map((_, index) => index + 1),
  );
  // No step raises the sum.
  for (const [index, [, rms]] of steps.entries()) {
    assert.ok(rms <= (steps[index - 1]?.[1] ?? fit.rmsBefore));
  }
  const { upper } = await hd.distance(part, part, { transform: fit.transform });
  assert.ok(upper < 1e-7, `${upper}`);
  part.dispose();
});

test("the best fit of a sphere in a larger one is concentric", async () => {
  // Radii 2.2 and 2: every distance is 0.2 there. Sixteen cells around lie alike in all quarters.
  const [larger, smaller] = [hd.shape("sphere-larger"), hd.shape("sphere")];
  const fit = await hd.bestFit(larger, smaller, {
    samples: 17,
    transform: { translation: [0.3, -0.2, 0.1] },
  });
  assert.ok(fit.converged, JSON.stringify(fit));
  near(fit.rms, 0.2, 1e-8);
  for (const length of fit.transform.translation) near(length, 0, 1e-6);
  for (const model of [larger, smaller]) model.dispose();
});

test("the best fit of two squares at heights 0 and 1 to a plane is their mean", async () => {
  // In the plane x, y they are beside each other and above a plane far larger than both:
  // the least squares of heights 0 and 1 over equal areas is the line through both means.
  const beside = (z) => {
    const { controlPoints, ...rest } = square(z);
    return {
      ...rest,
      controlPoints: controlPoints.map((value, at) => (at % 4 === 0 && z > 0 ? value + 1 : value)),
    };
  };
  const steps = hd.model([beside(0), beside(1)]);
  const wide = square(0);
  const plane = hd.model([
    {
      ...wide,
      controlPoints: wide.controlPoints.map((value, at) =>
        at % 4 < 2 ? 40 * (value - 0.5) : value,
      ),
    },
  ]);
  const fit = await hd.bestFit(steps, plane, { samples: 65 });
  assert.ok(fit.converged, JSON.stringify(fit));
  // By the eigenvalues of the covariance of x and z: var x = 1/3, var z = 1/4, cov = 1/4;
  // the smaller one is the mean square of the orthogonal distances.
  const [xx, zz, xz] = [1 / 3, 1 / 4, 1 / 4];
  const smaller = (xx + zz) / 2 - Math.hypot((xx - zz) / 2, xz);
  // Trapezoidal sums of 65 samples a side are off by 1/6 of the squared spacing.
  near(fit.rms, Math.sqrt(smaller), 1 / 64 ** 2);
  for (const model of [steps, plane]) model.dispose();
});

test("a model on itself stays, and wrong options are refused", async () => {
  const model = hd.model([square(0)]);
  const { transform, rms, steps, converged, ambiguous, freedoms } = await hd.bestFit(model, model);
  assert.deepEqual(transform, { rotation: [0, 0, 0, 1], translation: [0, 0, 0] });
  near(rms, 0, 1e-15);
  assert.deepEqual([steps, converged], [0, true]);
  // A square lies on itself in eight poses, and slides in its plane nowhere else as well.
  assert.ok(ambiguous.length >= 7, `${ambiguous.length}`);
  assert.equal(freedoms, 3);
  const refused = (options, code, message) =>
    assert.rejects(hd.bestFit(model, model, options), withCode(code, message));
  await refused({ tolerance: 0 }, "OPTION_OUT_OF_RANGE", /tolerance/);
  await refused({ relativeTolerance: 0 }, "OPTION_OUT_OF_RANGE", /relative tolerance/);
  await refused({ tolerance: 1, relativeTolerance: 1 }, "OPTION_INVALID", /both/);
  await refused({ maxSteps: 0 }, "OPTION_OUT_OF_RANGE", /maxSteps/);
  await refused({ outliers: 1 }, "OPTION_OUT_OF_RANGE", /outliers/);
  await refused({ outliers: 0.1, robust: "none" }, "OPTION_INVALID", /outliers/);
  await refused({ start: "elsewhere" }, "OPTION_INVALID", /start/);
  await refused({ samples: 1 }, "OPTION_OUT_OF_RANGE", /samples/);
  await refused({ signal: AbortSignal.abort() }, "CANCELLED");
  model.dispose();
});

/** Two squares at right angles and points of them, of which those of the second are 0.1 beside it, and one is far off. */
test("a fit of chosen faces and within a distance leaves out the others", async () => {
  const wall = { ...square(0), controlPoints: [0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 0, 1, 1, 1] };
  const part = hd.model([square(0), wall]);
  const steps = [0.2, 0.4, 0.6, 0.8];
  const grid = steps.flatMap((x) => steps.map((y) => [x, y]));
  const floor = grid.map(([x, y]) => [x, y, 0]);
  const beside = grid.map(([y, z]) => [-0.1, y, z]);
  const scan = hd.mesh({ positions: [...floor, ...beside, [0.5, 0.5, 5]].flat() });
  const options = { start: "given", norm: "none", maxDistance: 1 };
  const near = await hd.bestFit(scan, part, options);
  assert.deepEqual([near.samples, near.counted], [33, 32]);
  assert.deepEqual(near.leftOut, { beyond: 1, points: [0.5, 0.5, 5] });
  // Half of the points that count are 0.1 off.
  assert.ok(Math.abs(near.rms - 0.1 / Math.SQRT2) < 1e-9, `${near.rms}`);
  const chosen = await hd.bestFit(scan, part, { ...options, facesOfB: [1] });
  assert.ok(Math.abs(chosen.rms - 0.1) < 1e-9 && chosen.counted === 16, JSON.stringify(chosen));
  const ofA = await hd.bestFit(part, part, { norm: "none", samples: 4, facesOfA: [0] });
  assert.deepEqual([ofA.samples, ofA.counted], [16, 16]);
  await assert.rejects(
    hd.bestFit(scan, part, { facesOfB: [2] }),
    withCode("OPTION_INVALID", /face 2 of B/),
  );
  for (const model of [part, scan]) model.dispose();
});

/** A square of side 4 by its corners' heights. */
const bent = (heights) => ({
  ...square(0),
  controlPoints: square(0).controlPoints.map((value, at) => {
    if (at % 4 === 3) return 1;
    return at % 4 === 2 ? heights[Math.floor(at / 4)] : 4 * value;
  }),
});

test("the least zone of a saddle is its height, and a limit below it passes nowhere", async () => {
  const saddle = hd.model([bent([0.1, -0.1, -0.1, 0.1])]);
  const plane = hd.model([bent([0, 0, 0, 0])]);
  const options = { norm: "largest", start: "given", zone: { degrees: 2, translation: 0.1 } };
  const { zone, zoneProven, largest } = await hd.bestFit(saddle, plane, options);
  assert.ok(zone.lower <= 0.1 && zone.upper >= 0.1 - 1e-6, JSON.stringify(zone));
  assert.ok(zoneProven && zone.upper < 0.101, JSON.stringify(zone));
  near(largest, 0.1, 1e-3);
  assert.equal("passes" in zone, false);
  assert.equal(zone.refuted, 0);
  const limited = { ...options, zone: { limit: 0.09 } };
  assert.equal((await hd.bestFit(saddle, plane, limited)).zone.passes, false);
  const refused = (options, code, message) =>
    assert.rejects(hd.bestFit(saddle, plane, options), withCode(code, message));
  await refused({ zone: { degrees: 90 } }, "OPTION_OUT_OF_RANGE", /degrees/);
  await refused({ zone: { limit: 0.1 } }, "OPTION_INVALID", /limit/);
  await refused({ zone: { angle: 1 } }, "OPTION_INVALID", /angle/);
  await refused({ datums: [{ a: { plain: {} }, b: {} }] }, "OPTION_INVALID", /plain/);
  await refused({ datums: [{ a: { face: { at: 1 } }, b: {} }] }, "OPTION_INVALID", /at/);
  await refused({ pairs: [{ a: [0, 0, 0], b: [0, 0, 0], wait: 1 }] }, "OPTION_INVALID", /wait/);
  await refused({ norm: "largest", outliers: 0.1 }, "OPTION_INVALID", /largest/);
  for (const model of [saddle, plane]) model.dispose();
});

test("pairs, datums and boxes lay a part by hand", async () => {
  const [part, raised] = [hd.model([bent([0, 0, 0, 0])]), hd.model([bent([3, 3, 3, 3])])];
  const pair = (a) => ({ a, b: [a[0], a[1], 3] });
  const up = { plane: { point: [0, 0, 0], normal: [0, 0, 1] } };
  const face = { face: { index: 0 } };
  for (const options of [
    { pairs: [pair([0, 0, 0]), pair([4, 0, 0]), { ...pair([0, 4, 0]), weight: 2 }] },
    { datums: [{ a: face, b: face }] },
    { datums: [{ a: up, b: face }] },
    { start: "boxes" },
  ]) {
    const fit = await hd.bestFit(part, raised, { norm: "none", ...options });
    near(fit.transform.translation[2], 3, 1e-9);
    assert.ok(fit.converged && fit.rms < 1e-9 && fit.steps === 0, JSON.stringify(fit));
    assert.deepEqual(fit.taken, options.datums && [3]);
  }
  await assert.rejects(
    hd.bestFit(part, raised, { datums: [{ a: up, b: { point: { point: [0, 0, 0] } } }] }),
    withCode("OPTION_INVALID", /kinds/),
  );
  for (const model of [part, raised]) model.dispose();
});
