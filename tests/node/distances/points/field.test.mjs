import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, near, square, withCode } from "../../support.mjs";

let hd;
let models;
before(async () => {
  hd = await create();
  models = [hd.model([square(0)]), hd.model([square(2)])];
});
after(() => {
  for (const model of models) model.dispose();
  hd.dispose();
});

test("the field of a square below another is their distance, by area", async () => {
  const fractions = [];
  const options = { samples: 5, onProgress: (fraction) => fractions.push(fraction) };
  const { deviations, statistics, diagonal } = await hd.field(...models, options);
  assert.equal(deviations.length, 1);
  const [{ face, counts, distances, signed, areas }] = deviations;
  assert.deepEqual([face, counts, distances.length], [0, [5, 5], 25]);
  for (const distance of distances) near(distance, 2, 1e-8);
  // The square looks up, and the samples lie below it.
  for (const sign of signed) near(sign, -2, 1e-8);
  near(
    areas.reduce((sum, area) => sum + area, 0),
    1,
    1e-12,
  );
  near(statistics.mean, 2, 1e-8);
  near(diagonal, Math.SQRT2, 1e-12);
  assert.equal(fractions.at(-1), 1);
});

test("the transform moves the samples, and an upper bound limits them", async () => {
  const transform = { translation: [0, 0, 1.5] };
  const moved = await hd.field(...models, { samples: 2, transform });
  for (const distance of moved.deviations[0].distances) near(distance, 0.5, 1e-8);
  const limited = await hd.field(...models, { samples: 2, transform, upper: 0.25 });
  assert.deepEqual([...limited.deviations[0].distances], [0.25, 0.25, 0.25, 0.25]);
});

test("wrong options of a field are refused", async () => {
  const field = (options) => hd.field(...models, options);
  await assert.rejects(field({ samples: 1 }), withCode("OPTION_OUT_OF_RANGE", /samples/));
  await assert.rejects(field({ upper: -1 }), withCode("OPTION_OUT_OF_RANGE", /upper/));
  await assert.rejects(field({ method: "iteration" }), withCode("OPTION_INVALID", /method/));
  await assert.rejects(field({ signal: AbortSignal.abort() }), withCode("CANCELLED"));
  await assert.rejects(hd.field(models[0], {}), withCode("ARGUMENT_INVALID", /^b /));
});
