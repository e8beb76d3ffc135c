// Which edge is near a point of a face, and how long it is: a plate with a round end.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { edgeNear } = await moduleOf("measuring/edges.ts");

/** Parts of the half circle. */
const PARTS = 12;

/** A drawn model whose faces have these borders, each a list of points. */
function model(...borders) {
  const positions = [];
  const edges = [];
  const ends = [];
  for (const border of borders) {
    for (const [index, point] of border.entries()) {
      if (index > 0) edges.push(positions.length / 3 - 1, positions.length / 3);
      positions.push(...point);
    }
    ends.push(edges.length);
  }
  return {
    box: { min: [-3, -1, 0], max: [1, 1, 1] },
    tessellation: { positions: new Float32Array(positions), origin: [0, 0, 0] },
    outline: { edges: new Uint32Array(edges), ends },
    faceNames: borders.map((_, index) => `${index}`),
  };
}

// From the left, below, round the end and back: smooth where the lines meet the half circle.
const round = Array.from({ length: PARTS + 1 }, (_, index) => {
  const angle = Math.PI * (index / PARTS - 0.5);
  return [Math.cos(angle), Math.sin(angle), 0];
});
const plate = [[-3, -1, 0], ...round, [-3, 1, 0], [-3, -1, 0]];
// The wall along the line below: its corners are those of the line.
const wall = [
  [-3, -1, 0],
  [0, -1, 0],
  [0, -1, 1],
  [-3, -1, 1],
  [-3, -1, 0],
];

const near = (found, expected) => assert.ok(Math.abs(found - expected) < 1e-6, `${found}`);

test("an edge ends at its corners and at those of other faces", () => {
  const alone = edgeNear(model(plate), 0, [-1.5, -0.9, 0]);
  near(alone.distance, 0.1);
  // Nothing says where the lines end.
  const chord = 2 * Math.sin(Math.PI / PARTS / 2);
  near(alone.edge.length, 6 + PARTS * chord);
  assert.equal(alone.edge.circle, undefined);
  const straight = edgeNear(model(plate, wall), 0, [-1.5, -0.9, 0]).edge;
  near(straight.length, 3);
  const left = edgeNear(model(plate, wall), 0, [-2.9, 0, 0]).edge;
  near(left.length, 2);
});

test("an edge on a circle is as long as its arc, and closed where it ends in itself", () => {
  const other = wall.map(([x, y, z]) => [x, -y, z]);
  const arc = edgeNear(model(plate, wall, other), 0, [0.9, 0, 0]).edge;
  near(arc.length, Math.PI);
  near(arc.circle.radius, 1);
  assert.ok(!arc.isClosed);
  const back = round.slice(1).map(([x, y]) => [-x, -y, 0]);
  const circle = edgeNear(model([...round, ...back]), 0, [0.9, 0.1, 0]).edge;
  near(circle.length, 2 * Math.PI);
  assert.ok(circle.isClosed);
  assert.equal(edgeNear(model([]), 0, [0, 0, 0]), undefined);
});
