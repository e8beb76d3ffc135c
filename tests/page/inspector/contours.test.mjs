// The contours of a section, and the part of its plane that is plotted: against plane geometry.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, Plane, Vector3 } from "three";
import { moduleOf } from "../support/module.mjs";

const { contourOf } = await moduleOf("inspection/cut/contours.ts");
const { fitted, frameOf } = await moduleOf("inspection/cut/frame.ts");

/** The cube [-1, 1]³ of twelve triangles whose normals are outwards; a vertex's deviation is its x. */
const cube = (() => {
  const corners = Array.from({ length: 8 }, (_, index) =>
    [1, 2, 4].map((bit) => (index & bit ? 1 : -1)),
  );
  const quads = ["0462", "1375", "0154", "2673", "0231", "4576"];
  const indices = quads.flatMap((quad) => {
    const [a, b, c, d] = [...quad].map(Number);
    return [a, b, c, a, c, d];
  });
  return {
    positions: new Float32Array(corners.flat()),
    indices: new Uint32Array(indices),
    signed: Float32Array.from(corners, ([x]) => x),
    distances: new Float32Array(8).fill(1),
  };
})();

/** The section by a plane through a point, with directions that are orthogonal to the normal. */
function sectionOf(normal, point) {
  const plane = new Plane().setFromNormalAndCoplanarPoint(normal.clone().normalize(), point);
  const up = new Vector3(0, 0, 1);
  if (Math.abs(plane.normal.z) > 0.9) up.set(0, 1, 0);
  up.addScaledVector(plane.normal, -up.dot(plane.normal)).normalize();
  return { plane, up, right: new Vector3().crossVectors(up, plane.normal) };
}

/** The length of a contour, and the area that it encloses to its left. */
function measured(pieces) {
  let [length, area] = [0, 0];
  for (const { from, to } of pieces) {
    length += Math.hypot(to.x - from.x, to.y - from.y);
    area += (from.x * to.y - to.x * from.y) / 2;
  }
  return [length, area];
}

const near = (found, expected, what) =>
  assert.ok(Math.abs(found - expected) < 1e-6, `${what}: ${found}, expected ${expected}`);

test("the middle of a cube across its diagonal is a hexagon of side √2", () => {
  const section = sectionOf(new Vector3(1, 1, 1), new Vector3());
  const pieces = contourOf(cube, new Matrix4(), section, "a");
  const [length, area] = measured(pieces);
  near(length, 6 * Math.SQRT2, "length");
  near(Math.abs(area), 3 * Math.sqrt(3), "area");
  for (const { side, from, to } of pieces) {
    assert.equal(side, "a");
    for (const { x, y, deviation } of [from, to]) {
      assert.ok(Math.hypot(x, y) < Math.SQRT2 + 1e-6);
      // Deviations are linear on triangles.
      near(section.right.x * x + section.up.x * y, deviation, "deviation");
    }
  }
});

test("a model that is moved, turned and scaled is cut where it is", () => {
  const matrix = new Matrix4().makeRotationZ(Math.PI / 4).scale(new Vector3(3, 3, 3));
  matrix.setPosition(10, 20, 30);
  // Across its edges it is as wide as its diagonal.
  const section = sectionOf(new Vector3(1, 0, 0), new Vector3(10, 0, 0));
  const pieces = contourOf(cube, matrix, section, "b");
  const { left, right, bottom, top } = frameOf(pieces.flatMap(({ from, to }) => [from, to]));
  near(right - left, 6 * Math.SQRT2, "width");
  near(top - bottom, 6, "height");
  near(Math.abs(measured(pieces)[1]), 36 * Math.SQRT2, "area");
  const aside = sectionOf(new Vector3(1, 0, 0), new Vector3(20, 0, 0));
  assert.deepEqual(contourOf(cube, matrix, aside, "b"), []);
});

test("contours are closed in one direction: what is cut is on one side of all pieces", () => {
  for (const normal of [new Vector3(1, 2, 3), new Vector3(-1, 0.3, 0.2)]) {
    const pieces = contourOf(cube, new Matrix4(), sectionOf(normal, new Vector3(0.1, 0, 0)), "a");
    const starts = new Map(
      pieces.map(({ from }) => [`${from.x.toFixed(6)} ${from.y.toFixed(6)}`, 1]),
    );
    for (const { to } of pieces) assert.ok(starts.has(`${to.x.toFixed(6)} ${to.y.toFixed(6)}`));
    assert.ok(Math.abs(measured(pieces)[1]) > 1);
  }
});

test("a plot has one scale along both directions, holds all with a margin, and has a size", () => {
  const box = { left: -2, right: 4, bottom: 1, top: 2 };
  for (const size of [
    [300, 200],
    [100, 400],
  ]) {
    const { left, right, bottom, top } = fitted(box, 0.5, size);
    near((right - left) / size[0], (top - bottom) / size[1], "scale");
    assert.ok(
      left <= -2.5 + 1e-9 && right >= 4.5 - 1e-9 && bottom <= 0.5 + 1e-9 && top >= 2.5 - 1e-9,
    );
    near((left + right) / 2, 1, "middle");
  }
  const { left, right } = fitted(box, 0.5, [0, -5]);
  assert.ok(Number.isFinite(left) && right > left);
  assert.equal(frameOf([]), undefined);
});
