// What fits the points of a face: against surfaces of known sizes.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { fitOf, fromAxis } = await moduleOf("measuring/fit/surfaces.ts");
const { circleOf } = await moduleOf("measuring/fit/circle.ts");

/** A turn about an oblique axis and a shift, far from the origin. */
const place = ([x, y, z], shift) => {
  const [c, s] = [Math.cos(0.7), Math.sin(0.7)];
  const [a, b] = [c * x - s * y, s * x + c * y];
  const turned = [a, c * b - s * z, s * b + c * z];
  return turned.map((at, axis) => at + shift[axis]);
};
const SHIFT = [100, -40, 7];

/** Points of a part of a surface about z, by the angle about it from 0 to `end` and a parameter from 0 to 1. */
const part = (at, end = 2) =>
  Array.from({ length: 60 }, (_, index) => {
    const [angle, along] = [(end * (index % 10)) / 9, Math.floor(index / 10) / 5];
    const { out, up, normal } = at(along);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return {
      point: place([out * c, out * s, up], SHIFT),
      normal: place([normal[0] * c, normal[0] * s, normal[1]], [0, 0, 0]),
    };
  });

const near = (found, expected, tolerance = 1e-9) =>
  assert.ok(Math.abs(found - expected) <= tolerance * Math.abs(expected), `${found}: ${expected}`);

test("a part of a cylinder, a cone, a sphere and a torus is known, with its sizes", () => {
  const cylinder = fitOf(part((along) => ({ out: 2.5, up: 4 * along, normal: [1, 0] })));
  assert.equal(cylinder.kind, "cylinder");
  near(cylinder.radius, 2.5);
  assert.ok(cylinder.residual < 1e-10);

  const [c, s] = [Math.cos(0.3), Math.sin(0.3)];
  const cone = fitOf(
    part((along) => ({ out: (1 + 3 * along) * s, up: (1 + 3 * along) * c, normal: [c, -s] })),
  );
  assert.equal(cone.kind, "cone");
  near(cone.angle, 0.3);
  near(fromAxis(place([2 * s, 0, 2 * c], SHIFT), cone.center, cone.axis), 2 * s);

  const ball = fitOf(
    part((along) => {
      const up = 0.2 + along;
      return { out: 3 * Math.cos(up), up: 3 * Math.sin(up), normal: [Math.cos(up), Math.sin(up)] };
    }),
  );
  assert.equal(ball.kind, "sphere");
  near(ball.radius, 3);
  for (const [axis, at] of place([0, 0, 0], SHIFT).entries()) near(ball.center[axis], at);

  const ring = fitOf(
    part((along) => {
      const up = 2 * along;
      return {
        ...{ out: 5 + 0.7 * Math.cos(up), up: 0.7 * Math.sin(up) },
        normal: [Math.cos(up), Math.sin(up)],
      };
    }),
  );
  assert.equal(ring.kind, "torus");
  near(ring.radius, 0.7, 1e-7);
  near(ring.around, 5, 1e-7);
});

test("a cone of a small angle is no cylinder, and one that is off by rounding is", () => {
  const angle = 1e-4;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const almost = part((along) => ({ out: 2 + s * along, up: c * along, normal: [c, -s] }));
  assert.equal(fitOf(almost).kind, "cone");
  near(fitOf(almost).angle, angle, 1e-3);
  assert.equal(fitOf(almost, 1e-3).kind, "cylinder");
});

test("a plane and a free form are none of them, and what is off is said", () => {
  assert.equal(fitOf(part((along) => ({ out: 1 + along, up: 0, normal: [0, 1] }))), undefined);
  const wave = part((along) => ({
    ...{ out: 2 + 0.3 * Math.sin(9 * along), up: 4 * along },
    normal: [1, -2.7 * Math.cos(9 * along)],
  }));
  assert.equal(fitOf(wave), undefined);
  // One point of a cylinder 0.001 off.
  const dented = part((along) => ({ out: 2.5, up: 4 * along, normal: [1, 0] }));
  const { point, normal } = dented[17];
  dented[17] = { normal, point: point.map((at, axis) => at + 0.001 * normal[axis]) };
  const { radius, residual } = fitOf(dented);
  near(radius, 2.5, 1e-4);
  assert.ok(residual > 0.0008 && residual < 0.0011, `${residual}`);
});

test("a circle is found by points of an arc, and none on a line", () => {
  const arc = [0, 0.1, 0.4, 0.5].map((at) =>
    place([1.5 * Math.cos(at), 1.5 * Math.sin(at), 2], SHIFT),
  );
  const { center, radius, residual } = circleOf(arc);
  near(radius, 1.5, 1e-7);
  for (const [axis, at] of place([0, 0, 2], SHIFT).entries()) near(center[axis], at, 1e-7);
  assert.ok(residual < 1e-7);
  const line = [0, 1, 2, 5].map((at) => place([at, 2 * at, 1], SHIFT));
  assert.ok((circleOf(line)?.radius ?? Number.POSITIVE_INFINITY) > 1e6);
});
