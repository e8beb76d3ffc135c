import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Hausdorff as Away } from "nurbs-hausdorff/worker";
import { createBoth, square, withCode } from "../../support.mjs";

let away;
let hd;
before(async () => {
  [away, hd] = await createBoth(Away);
});
after(() => {
  away.dispose();
  hd.dispose();
});

/** The box [-1, 1]³ as a mesh. */
const box = {
  positions: Array.from({ length: 8 }, (_, corner) =>
    [0, 1, 2].map((bit) => ((corner >> bit) & 1) * 2 - 1),
  ).flat(),
  triangles: [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]),
};

/** The signed distance from the box's boundary. */
function depth(point) {
  const excess = point.map((x) => Math.abs(x) - 1);
  return Math.hypot(...excess.map((x) => Math.max(x, 0))) + Math.min(Math.max(...excess), 0);
}

function check({ values, origin, spacing, counts: [nx, ny], bound, band, undecided }) {
  const unknown = new Set(undecided);
  values.forEach((value, place) => {
    const index = [place % nx, Math.floor(place / nx) % ny, Math.floor(place / nx / ny)];
    const truth = depth(index.map((k, axis) => origin[axis] + spacing * k));
    if (Math.abs(value) < band) {
      const expected = unknown.has(place) ? Math.abs(truth) : truth;
      assert.ok(Math.abs(value - expected) <= bound + 1e-14, `${value} for ${truth}`);
    } else {
      assert.ok(Math.abs(truth) >= band - bound - 1e-14 && value < 0 === truth < 0);
    }
  });
}

test("distances of a box are those of the formula, in the worker too", async () => {
  for (const engine of [hd, away]) {
    const model = await engine.mesh(box);
    const all = await engine.signedDistances(model, { resolution: 10 });
    assert.ok(all.values instanceof Float64Array && all.undecided instanceof Uint32Array);
    assert.equal(all.values.length, all.counts[0] * all.counts[1] * all.counts[2]);
    assert.equal(all.band, Infinity);
    check(all);
    const fractions = [];
    const options = {
      spacing: 0.05,
      band: 0.125,
      precision: "float32",
      onProgress: (f) => fractions.push(f),
    };
    const banded = await engine.signedDistances(model, options);
    assert.ok(banded.values instanceof Float32Array);
    assert.ok(banded.measured < banded.values.length);
    check(banded);
    assert.equal(fractions.at(-1), 1);
  }
});

test("open models and wrong options are refused", async () => {
  const open = hd.model([square()]);
  await assert.rejects(hd.signedDistances(open), withCode("NOT_CLOSED", /4 free edges/));
  const model = await hd.mesh(box);
  await assert.rejects(hd.signedDistances(model, { spacing: 0 }), withCode("OPTION_OUT_OF_RANGE"));
  await assert.rejects(hd.signedDistances(model, { spacings: 1 }), withCode("OPTION_INVALID"));
  await assert.rejects(hd.signedDistances(model, { transform: {} }), withCode("OPTION_INVALID"));
  const signal = AbortSignal.abort();
  await assert.rejects(hd.signedDistances(model, { signal }), withCode("CANCELLED"));
});
