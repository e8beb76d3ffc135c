// What is certain of the points that a map measures: the model is within the slack of each.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "./support/module.mjs";

const { edgeEnds, edgesOf } = await moduleOf("worker/map/triangles.ts");
const { joined, middlesOf } = await moduleOf("worker/map/base.ts");
const { placesOf } = await moduleOf("inspection/places/places.ts");

/** A part of the unit circle of this angle, as one edge with the normals of its ends. */
function arc(angle, lean = 0) {
  const at = (value) => [Math.cos(value), Math.sin(value), 0];
  const points = [...at(0), ...at(angle)];
  return {
    positions: new Float32Array(points),
    normals: new Float32Array([...at(lean), ...at(angle - lean)]),
    points: new Float64Array(points),
    slacks: new Float64Array(2),
  };
}

test("the model is within the slack of a middle, and of a middle of middles", () => {
  // Normals that lean make a bulge that the circle does not have.
  for (const lean of [0, 0.3, -0.3]) {
    const angle = 0.5;
    const flatness = 1 - Math.cos(angle / 2);
    const sampling = { isMesh: false, origin: [0, 0, 0], flatness };
    const ends = arc(angle, lean);
    const triangles = { indices: new Uint32Array([0, 1, 1]), faces: new Uint32Array(1) };
    const edge = edgesOf(triangles).filter((one) => new Set(edgeEnds(one)).size === 2);
    const first = middlesOf(ends, edge, sampling);
    const all = joined(ends, first);
    const halves = { indices: new Uint32Array([0, 2, 2]), faces: new Uint32Array(1) };
    const half = edgesOf(halves).filter((one) => new Set(edgeEnds(one)).size === 2);
    for (const { points, slacks } of [first, middlesOf(all, half, sampling)]) {
      const off = Math.abs(Math.hypot(...points) - 1);
      // But for the rounding of drawn points; where the bulge goes outwards the slack is attained.
      assert.ok(off <= slacks[0] + 1e-7 && slacks[0] < 0.2, `${lean}: ${off} of ${slacks[0]}`);
      assert.ok(slacks[0] >= flatness);
    }
    assert.equal(middlesOf(ends, edge, { ...sampling, isMesh: true }).slacks[0], 0);
  }
});

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
