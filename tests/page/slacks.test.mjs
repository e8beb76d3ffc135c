// What is certain of faces by the points that a map measures, and what certain bounds of faces make of a map.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "./support/module.mjs";

const { placesOf } = await moduleOf("worker/map/places.ts");
const { keepWithin } = await moduleOf("worker/map/bounded.ts");

/** Two triangles, each a face, with a common edge. */
const two = () => ({
  indices: new Uint32Array([0, 1, 2, 1, 3, 2]),
  faces: new Uint32Array([0, 1]),
  distances: new Float64Array([1, 2, 3, 4]),
  signed: new Float64Array([1, 2, -3, Number.NaN]),
  slacks: new Float64Array([0, 0.25, 2.5, 0]),
});

test("what is sure of a face is less by the slack of each of its vertices, and by rounding", () => {
  const [{ face, vertex, distance, lowest, highest, sure }, other] = placesOf(two(), 0);
  assert.deepEqual({ face, vertex, distance }, { face: 0, vertex: 2, distance: 3 });
  assert.deepEqual({ lowest, highest }, { lowest: -3, highest: 2 });
  assert.deepEqual(sure, { distance: 1.75, lowest: -0.5, highest: 1.75 });
  assert.deepEqual([other.face, other.vertex, other.signed], [1, 3, Number.NaN]);
  assert.equal(placesOf(two(), 0.5)[0].sure.lowest, 0);
  assert.equal(placesOf(two(), 0.5)[1].sure.distance, 3.5);
});

test("a map is kept within the certain bounds of faces, a common vertex within the larger one", () => {
  const map = two();
  const bounds = [
    { face: 0, upper: 0.5 },
    { face: 1, upper: 2.5 },
  ];
  assert.ok(keepWithin(map, bounds));
  assert.deepEqual([...map.distances], [0.5, 2, 2.5, 2.5]);
  assert.deepEqual([...map.signed], [0.5, 2, -2.5, Number.NaN]);
  assert.ok(!keepWithin(map, bounds));
});

test("the points of a scan are one face", () => {
  const scan = { ...two(), indices: new Uint32Array(), faces: new Uint32Array() };
  const [{ face, vertex }, ...others] = placesOf(scan, 0);
  assert.deepEqual([face, vertex, others.length], [0, 3, 0]);
  assert.ok(keepWithin(scan, [{ face: 0, upper: 2 }]));
  assert.deepEqual([...scan.distances], [1, 2, 2, 2]);
});
