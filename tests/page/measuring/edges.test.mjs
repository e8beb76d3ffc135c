// Which edge is near a point of a face, and how long it is: a plate with a round end.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Hausdorff } from "../../../dist/node.js";
import { moduleOf } from "../support/module.mjs";

const { edgeNear } = await moduleOf("measuring/edges.ts");
const { outline } = await moduleOf("worker/models/outline.ts");

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

// A plate of 80 by 50 by 8 with two bores of radius 9 at x = ±20, whose faces are cut beside the bores.
test("an edge of a face that is cut into pieces is whole", async () => {
  const hd = await Hausdorff.create({ backend: "cpu" });
  const file = new URL("../../../examples/parts/a.step", import.meta.url);
  const part = await hd.readCad(readFileSync(file), { name: "a.step" });
  const tessellation = await part.tessellate();
  const box = { min: [-40, -25, -4], max: [40, 25, 4] };
  const faceNames = Array.from({ length: part.faceCount }, (_, face) => `${face}`);
  const drawn = { box, tessellation, outline: outline(tessellation, box), faceNames };
  const lengthAt = (face, point) => edgeNear(drawn, face, point).edge.length;
  for (const [face, z] of [
    [0, -4],
    [1, 4],
  ]) {
    for (const y of [-20, 0, 8.98, 20]) measured(lengthAt(face, [40, y, z]), 50);
    measured(lengthAt(face, [3, 25, z]), 80);
    for (const angle of [0, 1.5, 3, 4.7]) {
      const at = [20 + 9 * Math.cos(angle), 9 * Math.sin(angle), z];
      const { edge } = edgeNear(drawn, face, at);
      measured(edge.length, 2 * Math.PI * 9);
      measured(edge.circle.radius, 9);
    }
  }
  // The bore's seam is no edge.
  measured(lengthAt(6, [-11, 0, 0]), 2 * Math.PI * 9);
  for (const owner of [part, hd]) owner.dispose();
});

/** Positions are float32, and rims chords. */
function measured(found, expected) {
  assert.ok(Math.abs(found - expected) < 1e-3, `${found} for ${expected}`);
}
