// node benches/page/outlines.mjs FILE…: outlines the faces of CAD files as the page does. Prints the length that is drawn,
// the length of edges that lie along no edge of another face, which a closed part has none of, and the milliseconds.
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { Hausdorff } from "../../dist/node.js";
import { moduleOf } from "../../tests/page/support/module.mjs";

/** The part of the diagonal within which edges of two faces lie along each other. */
const NEAR = 1e-3;
/** Cells of the grid in which edges are looked for, along the diagonal. */
const CELLS = 60;

const { outline } = await moduleOf("worker/models/outline.ts");
const { boundsOf } = await moduleOf("common/bounds.ts");
const hd = await Hausdorff.create({ backend: "cpu" });

const AXES = [0, 1, 2];
const minus = (a, b) => AXES.map((axis) => a[axis] - b[axis]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The edges of all faces: the face and both ends. */
function edgesOf({ positions }, { edges, ends }) {
  const at = (vertex) => AXES.map((axis) => positions[3 * vertex + axis]);
  let face = 0;
  return Array.from({ length: edges.length / 2 }, (_, index) => {
    while (2 * index >= ends[face]) face += 1;
    return { face, from: at(edges[2 * index]), to: at(edges[2 * index + 1]) };
  });
}

function distance(point, { from, to }) {
  const side = minus(to, from);
  const part = Math.max(0, Math.min(1, dot(minus(point, from), side) / dot(side, side)));
  return Math.hypot(...AXES.map((axis) => point[axis] - from[axis] - part * side[axis]));
}

/** The length of edges whose middles are near no edge of another face. */
function lengthAlone(edges, diagonal) {
  const [near, size] = [NEAR * diagonal, diagonal / CELLS];
  const cell = (value) => Math.floor(value / size);
  const cells = new Map();
  for (const edge of edges) {
    const [low, high] = [Math.min, Math.max].map((end, index) =>
      AXES.map((axis) => cell(end(edge.from[axis], edge.to[axis]) + (index ? near : -near))),
    );
    for (let x = low[0]; x <= high[0]; x++) {
      for (let y = low[1]; y <= high[1]; y++) {
        for (let z = low[2]; z <= high[2]; z++) {
          const key = [x, y, z].join();
          if (!cells.has(key)) cells.set(key, []);
          cells.get(key).push(edge);
        }
      }
    }
  }
  const isAlone = ({ face, from, to }) => {
    const middle = AXES.map((axis) => (from[axis] + to[axis]) / 2);
    const around = cells.get(middle.map(cell).join()) ?? [];
    return !around.some((other) => other.face !== face && distance(middle, other) < near);
  };
  return lengthOf(edges.filter(isAlone));
}

const lengthOf = (edges) =>
  edges.reduce((sum, { from, to }) => sum + Math.hypot(...minus(to, from)), 0);

for (const path of process.argv.slice(2)) {
  const name = basename(path).replace(/\.gz$/, "");
  const part = await hd.readCad(readFileSync(path), { name });
  const tessellation = await part.tessellate();
  const bounds = boundsOf(tessellation.positions);
  const started = performance.now();
  const outlined = outline(tessellation, bounds);
  const spent = performance.now() - started;
  const edges = edgesOf(tessellation, outlined);
  const alone = lengthAlone(edges, Math.hypot(...minus(bounds.max, bounds.min)));
  console.log(
    `${name}: ${lengthOf(edges).toFixed(1)} drawn, ${alone.toFixed(1)} along no other face, ${spent.toFixed(0)} ms`,
  );
  part.dispose();
}
hd.dispose();
