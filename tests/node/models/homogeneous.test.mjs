// Control points with and without their weights multiplied in.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, square, withCode } from "../support.mjs";

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd.dispose());

/** The circle's nine control points of degree 2, and the half circle's five: x, y, weight. */
function circle(quarters) {
  const points = [];
  for (let index = 0; index <= 2 * quarters; index++) {
    const angle = (index * Math.PI) / 4;
    const weight = index % 2 === 0 ? 1 : Math.SQRT1_2;
    points.push([Math.cos(angle) / weight, Math.sin(angle) / weight, weight]);
  }
  return points;
}

const knots = (quarters) => {
  const inner = Array.from({ length: quarters - 1 }, (_, index) => [index + 1, index + 1]).flat();
  return [0, 0, 0, ...inner, quarters, quarters, quarters];
};

/** The unit sphere as a surface of revolution, with or without its points multiplied by their weights. */
function sphere(homogeneous) {
  const controlPoints = circle(4).flatMap(([cos, sin, around]) =>
    circle(2).flatMap(([z, radius, along]) => {
      const weight = around * along;
      const factor = homogeneous ? weight : 1;
      return [radius * cos * factor, radius * sin * factor, z * factor, weight];
    }),
  );
  return { degree: [2, 2], counts: [9, 5], knotsU: knots(4), knotsV: knots(2), controlPoints };
}

test("a rational sphere is the same given both ways", async () => {
  const plain = hd.model([sphere(false)]);
  const flagged = hd.model([{ ...sphere(true), homogeneous: true }]);
  const { upper } = await hd.distance(plain, flagged, { symmetric: true, relativeTolerance: 1e-9 });
  assert.ok(upper < 1e-8, `${upper}`);
  const points = [0, 0, 2, 1, 1, 1, -0.3, 0.4, 0.1];
  for (const model of [plain, flagged]) {
    const { distances, bounds } = await hd.closestPoints(model, points);
    distances.forEach((distance, index) => {
      const truth = Math.abs(Math.hypot(...points.slice(3 * index, 3 * index + 3)) - 1);
      assert.ok(Math.abs(distance - truth) <= bounds[index] + 1e-12, `${distance}`);
    });
  }
});

test("points multiplied by their weights, passed without saying so, are another surface", async () => {
  const [right, wrong] = [sphere(false), sphere(true)].map((surface) => hd.model([surface]));
  const { lower } = await hd.distance(right, wrong, { symmetric: true });
  assert.ok(lower > 0.1, `${lower}`);
});

test("a weight that is not positive and a flag that is not a boolean are refused", () => {
  const surface = square(0);
  const controlPoints = surface.controlPoints.with(3, 0);
  const refused = (changes, check) =>
    assert.throws(() => hd.model([{ ...surface, ...changes }]), check);
  refused({ controlPoints, homogeneous: true }, withCode("WEIGHT_NOT_POSITIVE"));
  refused({ homogeneous: 1 }, withCode("ARGUMENT_INVALID", /homogeneous is number/));
});
