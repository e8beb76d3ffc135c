// Meshes and clouds of points at either side.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { fromThreeGeometry } from "nurbs-hausdorff/adapters";
import { meshFormatOf, readCad, readMesh } from "nurbs-hausdorff/cad";
import * as away from "nurbs-hausdorff/worker";
import { BoxGeometry, Matrix4, SphereGeometry } from "three";
import { create, near, square, withCode } from "../support.mjs";

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd.dispose());

/** A triangle over a half of the unit square, at this height. */
const triangle = (z) => ({
  positions: [0, 0, z, 1, 0, z, 0, 1, z],
  triangles: [0, 1, 2],
});

/** Fails unless the directed distance is in an interval of the default width. */
async function distanceIs(a, b, expected) {
  const result = await hd.distance(a, b);
  const { lower, upper, diagonal, converged } = result;
  assert.ok(converged && upper - lower <= 1e-6 * diagonal, `[${lower}, ${upper}]`);
  assert.ok(lower <= expected && expected <= upper, `${expected} is not in [${lower}, ${upper}]`);
  return result;
}

test("a mesh, a surface and points are measured to each other", async () => {
  const [mesh, surface] = [hd.mesh(triangle(3)), hd.model([square(0)])];
  const points = hd.mesh({ positions: new Float32Array([0, 0, 0, 1, 1, 0]) });
  const { witness } = await distanceIs(mesh, surface, 3);
  assert.equal(witness.a.triangle, 0);
  near(
    witness.a.barycentric.reduce((sum, weight) => sum + weight),
    1,
    1e-12,
  );
  // The corner (1, 1) is beside the triangle.
  await distanceIs(surface, mesh, Math.hypot(3, Math.SQRT1_2));
  await distanceIs(mesh, points, Math.hypot(3, 1));
  const { witness: ofPoints } = await distanceIs(points, mesh, Math.hypot(3, Math.SQRT1_2));
  assert.equal(ofPoints.a.index, 1);
  await distanceIs(points, surface, 0);
  await distanceIs(surface, points, 1);
  const { distances, faces, signed } = await hd.closestPoints(mesh, [0.25, 0.25, 5]);
  assert.deepEqual([...distances, ...signed], [2, 2]);
  assert.deepEqual([...faces], [0]);
  assert.deepEqual(mesh.boundingBox, { min: [0, 0, 3], max: [1, 1, 3] });
  near(mesh.area().lower, 0.5, 1e-12);
  for (const model of [mesh, surface, points]) model.dispose();
});

test("a geometry of three is moved by its matrix", async () => {
  const matrix = new Matrix4().makeRotationZ(Math.PI / 2).setPosition(0, 0, 1);
  const box = hd.mesh(fromThreeGeometry(new BoxGeometry(2, 4, 6), matrix));
  near(box.boundingBox.max[0], 2, 1e-12);
  near(box.boundingBox.max[2], 4, 1e-12);
  const sphere = hd.mesh(fromThreeGeometry(new SphereGeometry(1, 8, 6).toNonIndexed()));
  // The corners of the box are farthest from the sphere; its poles are corners of the mesh.
  const { lower } = await hd.distance(box, sphere);
  assert.ok(lower > Math.hypot(2, 1, 4) - 1 && lower < Math.hypot(2, 1, 4));
  assert.throws(
    () => fromThreeGeometry(new BoxGeometry(), new Matrix4().makePerspective(-1, 1, 1, -1, 1, 2)),
    withCode("ARGUMENT_INVALID", /affine/),
  );
  assert.throws(() => fromThreeGeometry({}), withCode("ARGUMENT_INVALID", /BufferGeometry/));
  for (const model of [box, sphere]) model.dispose();
});

const OBJ = "v 0 0 3\nv 1 0 3\nv 1 1 3\nv 0 1 3\nf 1 2 3 4\n";

test("files of meshes are read, in the worker too", async () => {
  assert.equal(meshFormatOf("a.b.STL"), "stl");
  assert.equal(meshFormatOf("a.step"), undefined);
  const bytes = new TextEncoder().encode(OBJ);
  const surface = hd.model([square(0)]);
  const mesh = await readMesh(bytes, "obj", { unit: 0.001 });
  assert.equal(mesh.unit, 0.001);
  await distanceIs(surface, mesh, 3);
  await assert.rejects(readMesh(bytes, "stl"), withCode("MESH_SYNTAX", /STL/));
  await assert.rejects(readMesh(bytes, "dxf"), withCode("ARGUMENT_INVALID", /dxf/));
  assert.deepEqual(
    [mesh.report.kind, mesh.report.faces, mesh.report.skipped, mesh.report.notes],
    ["mesh", 1, [], []],
  );
  const worker = await away.Hausdorff.create({ backend: "cpu" });
  const there = await worker.readMesh(bytes, "obj");
  const same = await worker.mesh(triangle(3));
  const { lower, upper } = await worker.distance(there, same);
  assert.ok(lower <= Math.SQRT1_2 && Math.SQRT1_2 <= upper);
  for (const owner of [surface, mesh, there, same, worker]) owner.dispose();
});

/** A STEP file of this data. */
const step = (data) =>
  `ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n${data}\nENDSEC;\nEND-ISO-10303-21;\n`;

test("a STEP file of triangles alone is a mesh, in the worker too", async () => {
  const corners = "((0.,0.,3.),(1.,0.,3.),(0.,1.,3.))";
  const bytes = new TextEncoder().encode(
    step(`#1=COORDINATES_LIST('',3,${corners});
#2=TRIANGULATED_FACE('tri',#1,3,((0.,0.,1.)),$,(),((1,2,3)));
#3=TESSELLATED_SHELL('loose',(#2),$);`),
  );
  await assert.rejects(readCad(bytes), withCode("STEP_TRIANGLES", /triangles/));
  const mesh = await readMesh(bytes, "stp", { unit: 0.001 });
  assert.equal(mesh.unit, 0.001);
  const { kind, unit, skipped, notes } = mesh.report;
  assert.deepEqual([kind, unit, skipped, notes[0].code], ["mesh", 0.001, [], "STEP_LOOSE"]);
  assert.equal((await readMesh(bytes, "obj")).boundingBox.max[2], 3, "content decides");
  const worker = await away.Hausdorff.create({ backend: "cpu" });
  const there = await worker.readMesh(bytes, "step");
  assert.deepEqual(there.report.notes, notes);
  for (const owner of [mesh, there, worker]) owner.dispose();
});

test("a glTF has its buffers in the resources", async () => {
  const positions = new Float32Array([0, 0, 3, 1, 0, 3, 0, 1, 3]);
  const gltf = {
    asset: { version: "2.0" },
    nodes: [{ mesh: 0, skin: 0, name: "bent\u001b" }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3" }],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    buffers: [{ uri: "data/a%20b.bin", byteLength: 36 }],
  };
  const bytes = new TextEncoder().encode(JSON.stringify(gltf));
  await assert.rejects(readMesh(bytes, "gltf"), withCode("MESH_SYNTAX", /a%20b\.bin/));
  const mesh = await readMesh(bytes, "gltf", { resources: { "data/a b.bin": positions.buffer } });
  assert.deepEqual(mesh.boundingBox, { min: [0, 0, 3], max: [1, 1, 3] });
  const [note] = mesh.report.notes;
  assert.equal(note.face, "bent\ufffd");
  assert.match(note.why, /skin/);
  mesh.dispose();
});

test("scans are read by a module of their own, in the worker too", async () => {
  const seed = new URL("../../soundness/fuzz/seeds/mesh_file/scans/", import.meta.url);
  // A byte before each file names its reader.
  const file = async (name) => (await readFile(new URL(name, seed))).subarray(1);
  const plain = await readMesh(await file("points-las"), "las", { unit: 0.001 });
  const packed = await readMesh(await file("points-laz"), "laz");
  assert.deepEqual([plain.unit, packed.unit], [0.001, null]);
  // The least and the largest of k * k * 37 % 2003 - 900 by 0.001 and 100, of 31 * k % 83 by 0.01
  // and -20, of k % 7 - 3 by 0.5 and 0.25.
  near(plain.boundingBox.max[1], 0.01 * 82 - 20, 1e-12);
  assert.deepEqual(plain.boundingBox, packed.boundingBox);
  assert.equal(plain.boundingBox.min[2], -1.25);
  const worker = await away.Hausdorff.create({ backend: "cpu" });
  const scan = await worker.readMesh(await file("scans-e57"), "e57");
  assert.equal(scan.unit, 1);
  const known = await readMesh(await file("points-las"), "e57");
  assert.deepEqual(known.boundingBox, plain.boundingBox, "content decides");
  const cut = (await file("scans-e57")).subarray(0, 100);
  await assert.rejects(readMesh(cut, "e57"), withCode("MESH_SYNTAX", /E57/));
  for (const owner of [plain, packed, known, scan, worker]) owner.dispose();
});

test("wrong meshes are refused by their code", async () => {
  const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0];
  const refused = (input, code, message) =>
    assert.throws(() => hd.mesh(input), withCode(code, message));
  refused({ positions, triangles: [0, 1, 3] }, "TRIANGLE_INDEX", /triangle 0/);
  refused({ positions, triangles: [0, 1] }, "TRIANGLE_INDEX");
  refused({ positions, triangles: [0, 1, -1] }, "ARGUMENT_INVALID", /triangles\[2\]/);
  refused({ positions, triangles: [] }, "NO_FACETS");
  refused({ positions: [] }, "NO_FACETS");
  refused({ positions: [0, 0, Number.NaN] }, "POINT_OUT_OF_RANGE");
  refused({ positions: [0, 0] }, "ARGUMENT_INVALID", /multiple of 3/);
  refused({ positions, unit: -1 }, "UNIT_INVALID");
  refused({ positions, faces: [] }, "OPTION_INVALID", /faces/);
  refused({ positions, triangles: [0, 1, 2], groups: [{ triangles: 2 }] }, "MESH_GROUPS");
  refused({ positions, triangles: [0, 1, 2], groups: [{ triangles: -1 }] }, "ARGUMENT_INVALID");
  const [mesh, surface] = [hd.mesh(triangle(0)), hd.model([square(0)])];
  const unsupported = withCode("FACETS_UNSUPPORTED");
  await assert.rejects(hd.distance(mesh, surface, { method: "iteration" }), unsupported);
  const cloud = hd.mesh({ positions });
  await assert.rejects(hd.clearance(cloud, surface), unsupported);
  assert.throws(() => mesh.update(0, []), unsupported);
  for (const model of [mesh, cloud, surface]) model.dispose();
});

/** Two squares of half a unit area each, the second one at this height. */
const grouped = (z) => ({
  positions: [...triangle(0).positions, ...triangle(z).positions],
  triangles: [0, 1, 2, 3, 4, 5],
  groups: [{ name: "low", triangles: 1 }, { triangles: 1 }],
});

test("the groups of a mesh are its faces, in the worker too", async () => {
  const worker = await away.Hausdorff.create({ backend: "cpu" });
  for (const engine of [hd, worker]) {
    const [a, b] = [await engine.mesh(grouped(1)), await engine.mesh(grouped(1.5))];
    const { facesOfA, facesOfB } = await engine.diff(a, b, { limit: 0.1 });
    assert.deepEqual(
      facesOfA.map(({ state }) => state),
      ["unchanged", "changed"],
    );
    near(facesOfB[1].lower, 0.5, 1e-3);
    assert.equal(facesOfA[0].witness.a.faceName, "low");
    const { deviations, statistics } = await engine.field(a, b, { samples: 2 });
    assert.deepEqual(
      deviations.map(({ face, counts }) => [face, ...counts]),
      [
        [0, 6, 1],
        [1, 6, 1],
      ],
    );
    assert.equal(deviations[1].triangles.length, 3 * 4);
    assert.deepEqual(new Set(deviations[1].distances), new Set([0.5]));
    near(statistics.mean, 0.25, 1e-12);
    for (const model of [a, b]) model.dispose();
  }
  worker.dispose();
});

test("a mesh and points are fitted to surfaces and meshes", async () => {
  const sphere = fromThreeGeometry(new SphereGeometry(1, 24, 16));
  const { positions } = sphere;
  const moved = Float64Array.from(
    positions,
    (value, index) => value + [0.05, -0.02, 0.03][index % 3],
  );
  const [ball, mesh, points] = [
    hd.mesh(sphere),
    hd.mesh({ ...sphere, positions: moved }),
    hd.mesh({ positions: moved }),
  ];
  const exact = hd.shape("sphere");
  for (const part of [mesh, points]) {
    const { transform, rms, converged } = await hd.bestFit(part, ball);
    assert.ok(converged && rms < 5e-3, `${rms}`);
    for (const [axis, shift] of [-0.05, 0.02, -0.03].entries()) {
      near(transform.translation[axis], shift, 5e-3);
    }
    const { rms: toSurface, rmsBefore } = await hd.bestFit(part, exact);
    assert.ok(toSurface <= rmsBefore);
  }
  for (const model of [ball, mesh, points, exact]) model.dispose();
});

test("a mesh is displayed by its own triangles, and a cloud by its points", () => {
  // Far from the origin, where float32 alone would not tell the corners apart.
  const corners = [1e6, 0, 0, 1e6 + 1, 0, 0, 1e6, 1, 0];
  const mesh = hd.mesh({ positions: corners, triangles: [0, 1, 2] }).tessellate();
  const at = (vertex) =>
    [0, 1, 2].map((axis) => mesh.positions[3 * vertex + axis] + mesh.origin[axis]);
  assert.deepEqual([0, 1, 2].flatMap(at), corners);
  assert.deepEqual([...mesh.normals], [0, 0, 1, 0, 0, 1, 0, 0, 1]);
  assert.deepEqual(mesh.faces, [{ firstIndex: 0, indexCount: 3 }]);
  // Each face has its own range of indices.
  const two = {
    positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0],
    triangles: [0, 1, 2, 1, 3, 2, 0, 3, 1],
  };
  const groups = [
    { name: "one", triangles: 1 },
    { name: "two", triangles: 2 },
  ];
  assert.deepEqual(hd.mesh({ ...two, groups }).tessellate().faces, [
    { firstIndex: 0, indexCount: 3 },
    { firstIndex: 3, indexCount: 6 },
  ]);
  const cloud = hd.mesh({ positions: corners }).tessellate();
  assert.deepEqual([cloud.positions.length, cloud.indices.length], [9, 0]);
});

test("statistics are intervals, of points by count and else by area", async () => {
  const holds = ({ lower, upper }, expected) =>
    assert.ok(lower <= expected && expected <= upper, `${expected}: [${lower}, ${upper}]`);
  const [slope, ground] = [
    hd.mesh({ positions: [0, 0, 1, 1, 0, 3, 1, 1, 3, 0, 1, 1], triangles: [0, 1, 2, 0, 2, 3] }),
    hd.model([square(0)]),
  ];
  const found = await hd.statistics(slope, ground, { limit: 1.5, percentiles: [0.25] });
  assert.ok(found.converged && found.over === "area");
  holds(found.mean, 2);
  holds(found.rms, Math.sqrt(13 / 3));
  holds(found.percentiles[0].distance, 1.5);
  holds(found.beyond.part, 0.75);
  const points = hd.mesh({ positions: [0, 0, 1, 0.5, 0.5, 2, 1, 1, 6] });
  const counted = await hd.statistics(points, ground);
  assert.equal(counted.over, "count");
  holds(counted.mean, 3);
  await assert.rejects(hd.statistics(points, ground, { below: 1 }), withCode("OPTION_INVALID"));
  const there = await away.Hausdorff.create({ backend: "cpu" });
  try {
    const [a, b] = [await there.mesh({ positions: [0, 0, 4] }), await there.model([square(0)])];
    holds((await there.statistics(a, b)).mean, 4);
  } finally {
    there.dispose();
  }
});
