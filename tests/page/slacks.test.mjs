// What is certain of faces by the points that a map measures: the model is within the slack of each.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "./support/module.mjs";

const { placesOf } = await moduleOf("inspection/places/places.ts");

test("what is sure of a face is less by the slack of each of its vertices", () => {
  const map = {
    indices: new Uint32Array([0, 1, 2]),
    faces: new Uint32Array(1),
    distances: new Float32Array([1, 2, 3]),
    signed: new Float32Array([1, 2, -3]),
    slacks: new Float32Array([0, 0.25, 2.5]),
  };
  const [{ distance, lowest, highest, sure }] = placesOf({ a: map }, {});
  assert.deepEqual({ distance, lowest, highest }, { distance: 3, lowest: -3, highest: 2 });
  assert.deepEqual(sure, { distance: 1.75, lowest: -0.5, highest: 1.75 });
});
