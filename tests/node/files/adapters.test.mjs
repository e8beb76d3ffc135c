// The adapters on geometry that the libraries themselves make and evaluate.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import startOcct from "@bitbybit-dev/occt/bitbybit-dev-occt/node.js";
import { fromOcct, fromRhino, fromThree, fromVerb } from "nurbs-hausdorff/adapters";
import startReplicad from "replicad-opencascadejs";
import startRhino from "rhino3dm";
import { Vector3, Vector4 } from "three";
import { NURBSSurface } from "three/examples/jsm/curves/NURBSSurface.js";
import verb from "verb-nurbs/build/js/verb.es.js";
import { create, near, withCode } from "../support.mjs";

/** Parameters at which a library evaluates a surface of domain [0, 1] x [0, 1]. */
const PARAMETERS = [0, 0.1, 0.37, 0.5, 0.81, 1];
const PAIRS = PARAMETERS.flatMap((u) => PARAMETERS.map((v) => [u, v]));
/** Rounding of evaluations on both sides, for coordinates of size 1 to 10. */
const ROUNDING = 1e-12;

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd.dispose());

/** Fails unless all points lie on the model. */
async function liesOn(model, points) {
  const { distances, bounds } = await hd.closestPoints(model, points.flat());
  distances.forEach((distance, index) => {
    assert.ok(distance <= ROUNDING + bounds[index], `point ${points[index]} is ${distance} away`);
  });
}

/** Fails unless the directed distance contains `expected` in an interval of this width. */
async function distanceIs(a, b, expected, width = 1e-6) {
  const { lower, upper } = await hd.distance(a, b, { tolerance: width });
  near(lower, expected, 2 * width);
  near(upper, expected, 2 * width);
}

// A rational net with weights of every size, of degrees 2 and 1.
const WEIGHTS = [
  [1, 2],
  [0.5, 1],
  [3, 1],
];
const POINTS = [
  [
    [0, 0, 0],
    [0, 4, 1],
  ],
  [
    [2, 0, 3],
    [2, 4, 2],
  ],
  [
    [5, 1, 0],
    [5, 4, 1],
  ],
];
const KNOTS = [
  [0, 0, 0, 1, 1, 1],
  [0, 0, 1, 1],
];

test("a NURBSSurface of three", async () => {
  const net = POINTS.map((row, i) =>
    row.map(([x, y, z], j) => new Vector4(x, y, z, WEIGHTS[i][j])),
  );
  const surface = new NURBSSurface(2, 1, ...KNOTS, net);
  const points = PAIRS.map(([u, v]) => {
    const point = new Vector3();
    surface.getPoint(u, v, point);
    return point.toArray();
  });
  await liesOn(hd.model(fromThree(surface)), points);
});

test("a NurbsSurface of verb", async () => {
  const surface = verb.geom.NurbsSurface.byKnotsControlPointsWeights(
    2,
    1,
    ...KNOTS,
    POINTS,
    WEIGHTS,
  );
  await liesOn(
    hd.model(fromVerb(surface)),
    PAIRS.map(([u, v]) => surface.point(u, v)),
  );
});

test("what is no surface of the library is refused", () => {
  for (const adapt of [fromThree, fromVerb, fromRhino]) {
    for (const input of [{}, undefined, null, 1]) {
      assert.throws(() => adapt(input), withCode("ARGUMENT_INVALID"));
    }
  }
});

test("a surface of rhino3dm, whose control points are multiplied by their weights", async () => {
  const rhino = await startRhino();
  const sphere = new rhino.Sphere([1, 2, 3], 2).toNurbsSurface();
  const [[u0, u1], [v0, v1]] = [sphere.domain(0), sphere.domain(1)];
  const points = PAIRS.map(([u, v]) => sphere.pointAt(u0 + u * (u1 - u0), v0 + v * (v1 - v0)));
  for (const point of points) near(Math.hypot(...point.map((x, i) => x - [1, 2, 3][i])), 2, 1e-12);
  await liesOn(hd.model(fromRhino(sphere)), points);
});

test("a surface of revolution of rhino3dm, whose trimming curves are in angles", async () => {
  const rhino = await startRhino();
  const ball = (radius) => hd.model(fromRhino(new rhino.Sphere([1, 2, 3], radius).toBrep()));
  await distanceIs(ball(2.5), ball(2), 0.5);
});

test("a B-rep of rhino3dm is trimmed", async () => {
  const rhino = await startRhino();
  const cylinder = (height) => {
    const cylinder = new rhino.Cylinder(new rhino.Circle([0, 0, 0], 1));
    cylinder.height1 = 0;
    cylinder.height2 = height;
    return fromRhino(cylinder.toBrep(true, true), { unit: 0.001, name: "pin" });
  };
  const pin = cylinder(3);
  assert.equal(pin.unit, 0.001);
  assert.deepEqual(
    pin.surfaces.map(({ part, trim }) => [part, trim.length]),
    [
      ["pin face 0", 1],
      ["pin face 1", 1],
      ["pin face 2", 1],
    ],
  );
  // The edges of both caps are those of the wall.
  const edges = pin.surfaces.map(({ trim }) => new Set(trim.flat().map(({ edge }) => edge)));
  for (const cap of edges.slice(1)) assert.ok([...cap].every((edge) => edges[0].has(edge)));
  await distanceIs(hd.model(cylinder(4)), hd.model(pin), 1);
});

test("a box and an extrusion of rhino3dm", async () => {
  const rhino = await startRhino();
  const box = (x) => rhino.Brep.createFromBoundingBox(new rhino.BoundingBox([0, 0, 0], [x, 2, 3]));
  const [small, large] = [box(1), box(1.5)].map((brep) => hd.model(fromRhino(brep)));
  assert.equal(small.faceCount, 6);
  await distanceIs(large, small, 0.5);
  const circle = new rhino.Circle([0, 0, 0], 2);
  const extrusion = rhino.Extrusion.create(circle.toNurbsCurve(), 3, true);
  assert.equal(hd.model(fromRhino(extrusion)).faceCount, 3);
});

/** Boxes of both builds of OpenCASCADE, whose classes have other names. */
const builds = [
  ["bitbybit", startOcct, (oc, x) => new oc.BRepPrimAPI_MakeBox_2(x, 2, 3).Shape()],
  ["replicad", startReplicad, (oc, x) => new oc.BRepPrimAPI_MakeBox(x, 2, 3).Shape()],
];

for (const [name, start, makeBox] of builds) {
  test(`a shape of ${name}`, async () => {
    const oc = await start();
    const [small, large] = await Promise.all(
      [1, 1.5].map((x) => hd.readCad(fromOcct(oc, makeBox(oc, x)))),
    );
    assert.equal(small.faceCount, 6);
    const { faces, trims, exact, unit, skipped } = small.report;
    assert.deepEqual([faces, trims, exact, unit, skipped], [6, 24, 24, 0.001, []]);
    await distanceIs(large, small, 0.5);
  });
}

/** Solids of OpenCASCADE whose wires it does not write head to tail: faces and curves. */
const solids = [
  ["cylinder", 3, 6, (oc) => new oc.BRepPrimAPI_MakeCylinder_1(5, 4)],
  ["cone to its apex", 2, 5, (oc) => new oc.BRepPrimAPI_MakeCone_1(3, 0, 5)],
  ["truncated cone", 3, 6, (oc) => new oc.BRepPrimAPI_MakeCone_1(3, 1, 5)],
  ["ball", 1, 4, (oc) => new oc.BRepPrimAPI_MakeSphere_1(2)],
];

for (const [name, faces, trims, make] of solids) {
  test(`a ${name} of OpenCASCADE`, async () => {
    const oc = await startOcct();
    const { report } = await hd.readCad(fromOcct(oc, make(oc).Shape()));
    assert.deepEqual(report.skipped, []);
    assert.deepEqual([report.faces, report.trims, report.exact], [faces, trims, trims]);
  });
}

test("a module that cannot write is refused", () => {
  assert.throws(() => fromOcct({}, {}), withCode("ARGUMENT_INVALID", /BRepToolsWrapper\.Write/));
});
