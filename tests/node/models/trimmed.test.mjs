// Trimmed models as plain arrays and as interchange JSON, with units and instances.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, interchangeSquare, square, withCode } from "../support.mjs";

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd.dispose());

/** A straight trimming curve as plain arrays. */
const line = ([u0, v0], [u1, v1]) => ({
  degree: 1,
  knots: [0, 0, 1, 1],
  controlPoints: new Float64Array([u0, v0, 1, u1, v1, 1]),
});

/** The closed polygon through these points. */
const polygon = (...points) =>
  points.map((point, k) => line(point, points.at(k + 1 - points.length)));

/** The circle of radius 1/4 about the square's middle, clockwise if it is a hole. */
function circle(isHole = false) {
  const corners = [
    [1, 0],
    [1, 1],
    [0, 1],
    [-1, 1],
    [-1, 0],
    [-1, -1],
    [0, -1],
    [1, -1],
    [1, 0],
  ];
  const points = corners.map(([x, y], k) => [
    0.5 + x / 4,
    0.5 + ((isHole ? -1 : 1) * y) / 4,
    k % 2 === 0 ? 1 : Math.SQRT1_2,
  ]);
  const knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4];
  return [{ degree: 2, knots, controlPoints: points.flat(), gap: 1e-4, edge: 3 }];
}

const outer = () => polygon([0, 0], [1, 0], [1, 1], [0, 1]);
const plate = () => ({
  ...square(),
  trim: [outer(), circle(true)],
  faceName: "plate",
  kind: "plane",
  shell: 7,
  solid: 3,
});

/** The interchange JSON of surfaces given as plain arrays like those above. */
function interchange(surfaces) {
  const points = (flat, length) =>
    Array.from({ length: flat.length / length }, (_, k) =>
      Array.from(flat).slice(k * length, (k + 1) * length),
    );
  return {
    source: { file: "plate.step" },
    surfaces: surfaces.map(
      ({ trim, faceName, knotsU, knotsV, counts, controlPoints, degree, ...rest }) => ({
        ...rest,
        part: faceName,
        degree,
        knots_u: [...knotsU],
        knots_v: [...knotsV],
        ctrl: [0, 1].map((row) => points(controlPoints, 4).slice(2 * row, 2 * row + 2)),
        trim: trim?.map((loop) =>
          loop.map(({ controlPoints: curve, ...others }) => ({
            ...others,
            ctrl: points(curve, 3),
          })),
        ),
      }),
    ),
  };
}

test("a hole's radius is its middle's distance, from arrays and from JSON", async () => {
  const whole = hd.model([square()]);
  for (const input of [[plate()], { surfaces: [plate()] }, interchange([plate()])]) {
    const bored = hd.model(input);
    assert.equal(bored.faceCount, 1);
    assert.equal(bored.faceName(0), "plate");
    const result = await hd.distance(whole, bored, { symmetric: true });
    assert.ok(result.converged);
    assert.ok(result.forward.lower <= 0.25 && 0.25 <= result.forward.upper);
    assert.ok(result.reverse.lower === 0 && result.reverse.upper <= 1e-6 * result.diagonal);
    assert.equal(result.gap, 1e-4);
    assert.equal(result.unit, undefined);
    const { a, b } = result.witness;
    assert.equal(a.faceName, undefined);
    assert.equal(b.faceName, "plate");
    // The parameters of the square are x and y.
    assert.ok(Math.hypot(b.u - b.point[0], b.v - b.point[1]) < 1e-6);
    assert.ok(Math.abs(Math.hypot(b.u - 0.5, b.v - 0.5) - 0.25) < 1e-6);
  }
});

test("triangles and closest points are those of the trimmed surface", async () => {
  const bored = hd.model([square(-3), plate()]);
  const { positions, indices, origin, faces } = bored.tessellate({ tolerance: 1e-4 });
  assert.equal(faces.length, 2);
  const { firstIndex, indexCount } = faces[1];
  let area = 0;
  for (let k = firstIndex; k < firstIndex + indexCount; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => {
      const first = 3 * indices[k + corner];
      return [positions[first] + origin[0], positions[first + 1] + origin[1]];
    });
    area += 0.5 * Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  assert.ok(Math.abs(area - (1 - Math.PI / 16)) < 1e-3, `${area}`);
  const found = await hd.closestPoints(bored, [0.5, 0.5, 0]);
  assert.ok(Math.abs(found.distances[0] - 0.25) < 1e-6);
  assert.deepEqual([...found.faces], [1]);
});

test("instances place surfaces, and units are compared", async () => {
  const placed = (unit, size) =>
    hd.model({
      name: "two plates",
      unit,
      surfaces: [plate()],
      instances: [
        { surfaces: [0], transform: [size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0], name: "left" },
        { surfaces: [0], transform: [size, 0, 0, 2 * size, 0, size, 0, 0, 0, 0, size, 0] },
      ],
    });
  const [metres, millimetres] = [placed(1, 1), placed(1e-3, 1000)];
  assert.equal(metres.faceCount, 2);
  assert.equal(metres.name, "two plates");
  assert.deepEqual(metres.boundingBox.max, [3, 1, 0]);
  assert.equal(metres.faceName(0), "left / plate");
  assert.equal(metres.faceName(7), null);
  assert.equal(millimetres.unit, 1e-3);
  assert.ok(Math.abs(millimetres.gap - 0.1) < 1e-9);
  await assert.rejects(hd.distance(metres, millimetres), withCode("UNITS_DIFFER", /scale/));
  await assert.rejects(hd.diff(metres, millimetres), withCode("UNITS_DIFFER"));
  const result = await hd.distance(metres, millimetres, { scaleUnits: true });
  assert.equal(result.unit, 1);
  assert.ok(result.upper < 1e-5);
  assert.equal(hd.model([square()]).unit, null);
});

// One change to the plate for every refusal by the module.
const refusals = [
  ["TRIM_NO_LOOPS", { trim: [] }, /surface 1, 0 trimming loops/],
  ["TRIM_CURVE_INVALID", { trim: [[{ ...line([0, 0], [1, 1]), degree: 0 }]] }, /loop 0, curve 0/],
  [
    "TRIM_WEIGHT_NOT_POSITIVE",
    { trim: [[{ ...line([0, 0], [1, 1]), controlPoints: [0, 0, 1, 1, 1, 0] }]] },
    /weight of control point 1 is 0/,
  ],
  ["TRIM_LOOP_OPEN", { trim: [outer(), outer().slice(1)] }, /loop 1, curve 0/],
  ["TRIM_OUTSIDE_DOMAIN", { trim: [polygon([0, 0], [1.5, 0], [1, 1])] }, /loop 0, curve 0/],
  ["TRIM_LOOP_NO_AREA", { trim: [polygon([0, 0], [1, 1])] }],
  ["TRIM_REGION_NO_AREA", { trim: [outer(), polygon([0, 0], [0, 1], [1, 1], [1, 0])] }],
  ["TRIM_LOOPS_CROSS", { trim: [polygon([0, 0], [1, 1], [1, 0], [0, 0.5])] }],
  ["TRIM_WRONG_NESTING", { trim: [circle(true)] }, /clockwise/],
  ["GAP_INVALID", { gap: -1 }],
  ["ARGUMENT_INVALID", { trim: {} }, /surface 1: trim/],
  ["ARGUMENT_INVALID", { trim: [1] }, /loop 0/],
  ["ARGUMENT_INVALID", { trim: [[null]] }, /loop 0, curve 0 is null/],
  ["ARGUMENT_INVALID", { trim: [[{ ...line([0, 0], [1, 1]), controlPoints: [0, 0] }]] }, /three/],
  ["ARGUMENT_INVALID", { trim: [[{ ...line([0, 0], [1, 1]), edge: -1 }]] }, /edge/],
  ["ARGUMENT_INVALID", { faceName: 7 }, /surface 1: faceName/],
];

for (const [code, change, message] of refusals) {
  test(`a trimmed surface with wrong ${Object.keys(change)} is refused: ${code}`, () => {
    const model = [square(), { ...plate(), ...change }];
    assert.throws(() => hd.model(model), withCode(code, message));
  });
}

test("wrong instances and units are refused", () => {
  const model = (change) => () => hd.model({ surfaces: [square()], ...change });
  const transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
  const instance = (change) => model({ instances: [{ surfaces: [0], transform, ...change }] });
  assert.throws(instance({ surfaces: [1] }), withCode("INSTANCE_SURFACE", /instance 0/));
  assert.throws(instance({ transform: Array(12).fill(1) }), withCode("INSTANCE_TRANSFORM"));
  assert.throws(instance({ transform: [1] }), withCode("ARGUMENT_INVALID", /12/));
  assert.throws(instance({ surfaces: 0 }), withCode("ARGUMENT_INVALID", /surfaces/));
  assert.throws(model({ unit: 0 }), withCode("UNIT_INVALID"));
  assert.throws(model({ unit: "mm" }), withCode("ARGUMENT_INVALID", /unit/));
  const json = { ...interchangeSquare(), unit: -1 };
  assert.throws(() => hd.model(json), withCode("UNIT_INVALID"));
});

test("areas of the model and of its faces", () => {
  const model = hd.model([plate(), { ...square(), trim: [circle()], faceName: "disc" }]);
  const { lower, upper, faces } = model.area();
  const disc = Math.PI / 16;
  const ends = [...faces, { lower, upper }].map(Object.values);
  [1 - disc, disc, 1].forEach((expected, index) => {
    const [least, largest] = ends[index];
    assert.ok(least - 1e-8 <= expected && expected <= largest + 1e-8, `${ends[index]}`);
    assert.ok(largest - least <= 1e-6, `${ends[index]}`);
  });
});
