// Scores, here and in a worker, of boxes whose numbers have formulas.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import * as away from "nurbs-hausdorff/worker";
import { create, withCode } from "../../support.mjs";

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd?.dispose());

const triangles = [
  0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7,
  1, 7, 5,
];
const box = (x, y, z) => {
  const corners = [...Array(8).keys()].map((k) => [x * (k & 1), y * ((k >> 1) & 1), z * (k >> 2)]);
  return { positions: corners.flat(), triangles };
};
const holds = ({ lower, upper }, expected) =>
  assert.ok(lower <= expected && expected <= upper, `${expected}: [${lower}, ${upper}]`);

function check(found) {
  const h = 0.5;
  holds(found.forward.mean, (6 * h + 5 * h * h) / (52 + 10 * h));
  holds(found.reverse.mean, (6 * h - 5 * h * h + (4 / 3) * h ** 3) / 52);
  holds(found.hausdorff.distance, h);
  holds(found.volume.ratio, 8 / 9);
  holds(found.candidate.valid, 1);
  const [at] = found.thresholds;
  holds(at.normalPrecision, 1 - (6 + 10 * (h - 0.2)) / (52 + 10 * h));
  // The rim of the old end is near sides alone.
  holds(at.normalRecall, 1 - 6 / 52);
  holds(at.edgePrecision, 1 - (10 + 4 * (h - 0.2)) / 38);
  holds(at.edgeRecall, 1 - (10 - 8 * 0.2) / 36);
  holds(found.edgeLength.candidate, 38);
  assert.ok(at.normalAngle === 30 && at.normalF1.lower < at.f1.upper && at.edgeF1.upper < 1);
  assert.equal(found.met, true);
  assert.deepEqual(found.placement.rotation, [0, 0, 0, 1]);
}

const options = { thresholds: [0.2], atMost: { hausdorff: 0.6 } };

test("a deeper box has the distances of the formula", async () => {
  const [deep, truth] = [box(2, 3, 4.5), box(2, 3, 4)].map((arrays) => hd.mesh(arrays));
  check(await hd.score(deep, truth, options));
  const missed = await hd.score(deep, truth, { atLeast: { volumeRatio: 0.9 } });
  assert.ok(missed.met === false && missed.endedEarly && missed.hausdorff === undefined);
  const code = withCode("OPTION_INVALID");
  await assert.rejects(hd.score(deep, truth, { atLeast: { f2: 1 } }), code);
  await assert.rejects(hd.score(deep, truth, { threshold: 1 }), code);
  await assert.rejects(hd.score(deep, truth, { normalAngle: 91 }), withCode("OPTION_OUT_OF_RANGE"));
  await assert.rejects(
    hd.score(deep, truth, { featureAngle: -1 }),
    withCode("OPTION_OUT_OF_RANGE"),
  );
});

test("a worker scores, too", async () => {
  const there = await away.Hausdorff.create({ backend: "cpu" });
  try {
    const [deep, truth] = [await there.mesh(box(2, 3, 4.5)), await there.mesh(box(2, 3, 4))];
    check(await there.score(deep, truth, options));
  } finally {
    there.dispose();
  }
});
