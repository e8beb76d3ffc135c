// Maps of deviations: squares above each other, a sphere about another.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Hausdorff } from "nurbs-hausdorff/worker";
import { create, near, square, withCode } from "../../support.mjs";

let hd;
let models;
before(async () => {
  hd = await create();
  models = [hd.model([square(0)]), hd.model([square(2)])];
});
after(() => {
  for (const model of models) model.dispose();
  hd.dispose();
});

const columns = (flat) =>
  Array.from({ length: flat.length / 3 }, (_, at) => flat.slice(3 * at, 3 * at + 3));

test("the map of a square below another covers it, with their distance and the feet", async () => {
  const fractions = [];
  const maps = await hd.deviationMaps(...models, {
    onProgress: (fraction) => fractions.push(fraction),
  });
  assert.equal(maps.b, undefined);
  near(maps.diagonal, Math.SQRT2, 1e-12);
  const { positions, origin, indices, faces, points, distances, signed, feet, slacks } = maps.a;
  assert.deepEqual([positions.length, feet.length], [points.length, points.length]);
  assert.equal(faces.length, indices.length / 3);
  assert.ok(faces.every((face) => face === 0));
  for (const distance of distances) near(distance, 2, 1e-7);
  // The square looks up, and the samples lie below it.
  for (const value of signed) near(value, -2, 1e-7);
  for (const [at, [x, y, z]] of columns(points).entries()) {
    near(positions[3 * at] + origin[0], x, 1e-6);
    assert.deepEqual(
      [...feet.slice(3 * at, 3 * at + 3)].map((value) => value.toFixed(6)),
      [x.toFixed(6), y.toFixed(6), (z + 2).toFixed(6)],
    );
  }
  // A plane is its own triangles to a flatness of 5e-4 of the diagonal.
  for (const slack of slacks) assert.ok(slack <= 5e-4 * maps.diagonal + 1e-12);
  let area = 0;
  const corners = columns(points);
  for (let first = 0; first < indices.length; first += 3) {
    const [a, b, c] = [...indices.slice(first, first + 3)].map((corner) => corners[corner]);
    area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  near(area, 1, 1e-6);
  assert.equal(fractions.at(-1), 1);
});

test("coarse maps come first, and finer ones are linear between vertices to a step", async () => {
  // The distance from a point close above the square has nearly a cone.
  const above = [0.51, 0.52, 0.01];
  const point = hd.mesh({ positions: above });
  let coarse;
  const onCoarse = (maps) => {
    coarse = maps;
  };
  const { a: fine, diagonal } = await hd.deviationMaps(models[0], point, { onCoarse });
  const count = coarse.a.distances.length;
  assert.ok(count < fine.distances.length);
  assert.deepEqual(fine.distances.slice(0, count), coarse.a.distances);
  const [corners, middle] = [columns(fine.points), (one, other) => (one + other) / 2];
  const exact = (x, y, z) => Math.hypot(x - above[0], y - above[1], z - above[2]);
  for (const [at, corner] of corners.entries()) near(fine.distances[at], exact(...corner), 1e-7);
  const step = Math.max(...fine.distances) / 150;
  const offOf = ({ indices, distances }, edge) => {
    const [from, to] = [indices[edge], indices[edge - (edge % 3) + ((edge + 1) % 3)]];
    const ends = [corners[from], corners[to]];
    const [x, y, z] = [0, 1, 2].map((axis) => middle(ends[0][axis], ends[1][axis]));
    const length = Math.hypot(...[0, 1, 2].map((axis) => ends[0][axis] - ends[1][axis]));
    const off = Math.abs(middle(distances[from], distances[to]) - exact(x, y, z));
    return length < diagonal / 1000 ? 0 : off;
  };
  const worst = (map) => Math.max(...Array.from(map.indices, (_, edge) => offOf(map, edge)));
  assert.ok(worst(coarse.a) > step);
  assert.ok(worst(fine) <= step + 1e-7, `${worst(fine)} of ${step}`);
  point.dispose();
});

test("known bounds hold, and the farthest point is a vertex", async () => {
  const farthest = { face: 0, point: [0.3, 0.7, 0.5], foot: [0.3, 0.7, 2] };
  const { a } = await hd.deviationMaps(...models, {
    a: { uppers: [1.5], farthest },
    transform: { translation: [0, 0, 0.5] },
  });
  assert.ok(a.distances.every((distance) => distance <= 1.5));
  // It is in the model's own coordinates, before the transform.
  const at = columns(a.points).findIndex(([x, y, z]) => x === 0.3 && y === 0.7 && z === 0);
  assert.equal(a.distances[at], 1.5);
  assert.deepEqual([...a.feet.slice(3 * at, 3 * at + 3)], [0.3, 0.7, 2]);
});

test("a mesh has straight edges, and a cloud no triangles", async () => {
  const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
  const mesh = hd.mesh({ positions, triangles: [0, 1, 2, 0, 1, 3] });
  const cloud = hd.mesh({ positions });
  const { a, b } = await hd.deviationMaps(mesh, cloud, { a: {}, b: {} });
  assert.ok(a.slacks.every((slack) => slack === 0));
  assert.ok(a.faces.length > 2 && a.faces.every((face) => face === 0));
  // A point of the faces z = 0 or y = 0 is nearest to one of the four corners.
  for (const [at, [x, y, z]] of columns(a.points).entries()) {
    const all = columns(positions).map(([u, v, w]) => Math.hypot(u - x, v - y, w - z));
    near(a.distances[at], Math.min(...all), 1e-7);
  }
  assert.deepEqual([b.indices.length, b.distances.length], [0, 4]);
  for (const distance of b.distances) near(distance, 0, 1e-7);
  mesh.dispose();
  cloud.dispose();
});

test("wrong options of maps are refused, and what listeners throw ends them", async () => {
  const maps = (options) => hd.deviationMaps(...models, options);
  await assert.rejects(maps({ a: { uppers: [-1] } }), withCode("OPTION_OUT_OF_RANGE", /uppers/));
  await assert.rejects(maps({ a: { upper: 1 } }), withCode("OPTION_INVALID", /upper/));
  await assert.rejects(maps({ samples: 3 }), withCode("OPTION_INVALID", /samples/));
  await assert.rejects(maps({ onCoarse: 1 }), withCode("OPTION_INVALID", /onCoarse/));
  const farthest = { face: 0, point: [0, 0, Number.NaN], foot: [0, 0, 0] };
  await assert.rejects(maps({ a: { farthest } }), withCode("POINT_OUT_OF_RANGE"));
  await assert.rejects(maps({ signal: AbortSignal.abort() }), withCode("CANCELLED"));
  await assert.rejects(hd.deviationMaps(models[0], {}), withCode("ARGUMENT_INVALID", /^b /));
  const [sphere, torus] = [hd.shape("sphere"), hd.shape("torus")];
  const thrown = new Error("enough");
  const onCoarse = () => {
    throw thrown;
  };
  await assert.rejects(hd.deviationMaps(sphere, torus, { onCoarse }), thrown);
});

test("the worker's maps are those of the main entry, coarse ones too", async () => {
  const far = await Hausdorff.create();
  const pair = [await far.shape("sphere"), await far.shape("torus")];
  const options = { a: {}, b: {}, transform: { translation: [0.1, 0, 0] } };
  const own = [];
  const theirs = [];
  const shapes = [hd.shape("sphere"), hd.shape("torus")];
  const expected = await hd.deviationMaps(...shapes, {
    ...options,
    onCoarse: (maps) => own.push(maps),
  });
  const onCoarse = (maps) => theirs.push(maps);
  assert.deepEqual(await far.deviationMaps(...pair, { ...options, onCoarse }), expected);
  assert.deepEqual(theirs, own);
  assert.equal(own.length, 1);
  far.dispose();
});
