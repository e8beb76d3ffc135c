import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Hausdorff, NurbsModel } from "nurbs-hausdorff";
import { create, interchangeSquare, square, withCode } from "../support.mjs";

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd.dispose());

test("a model of plain arrays", () => {
  const model = hd.model([square(0), square(2)]);
  assert.ok(model instanceof NurbsModel);
  assert.equal(model.name, null);
  assert.equal(model.faceCount, 2);
  assert.deepEqual(model.boundingBox, { min: [0, 0, 0], max: [1, 1, 2] });
});

test("every kind of array is taken", () => {
  const { controlPoints } = square(3);
  for (const points of [[...controlPoints], controlPoints, Float32Array.from(controlPoints)]) {
    const model = hd.model([{ ...square(), controlPoints: points }]);
    assert.deepEqual(model.boundingBox.max, [1, 1, 3]);
  }
});

test("a model of interchange JSON, parsed or not", () => {
  for (const input of [interchangeSquare(1), JSON.stringify(interchangeSquare(1))]) {
    const model = hd.model(input);
    assert.equal(model.name, "square");
    assert.equal(model.faceCount, 1);
    assert.deepEqual(model.boundingBox, { min: [0, 0, 1], max: [1, 1, 1] });
  }
});

test("the input may change afterwards", () => {
  const input = square(0);
  const model = hd.model([input]);
  input.controlPoints.fill(7);
  assert.deepEqual(model.boundingBox.max, [1, 1, 0]);
});

test("every listed shape can be made", () => {
  const shapes = Hausdorff.shapes();
  assert.ok(shapes.length >= 10);
  for (const { name, title } of shapes) {
    const model = hd.shape(name);
    assert.ok(model.faceCount >= 1, name);
    assert.ok(title.length > 0);
  }
});

// One change to a valid surface for every refusal.
const refusals = [
  ["NON_FINITE", { knotsU: [0, 0, Number.NaN, 1] }, /surface 0.*knot/],
  ["NON_FINITE", { controlPoints: square().controlPoints.with(5, Infinity) }, /control point 1/],
  [
    "NUMBER_TOO_LARGE",
    { controlPoints: square().controlPoints.with(5, 1e155) },
    /control point 1.*1e155/,
  ],
  ["WEIGHT_NOT_POSITIVE", { controlPoints: square().controlPoints.with(7, 0) }, /control point 1/],
  [
    "WEIGHT_RATIO_TOO_LARGE",
    { controlPoints: square().controlPoints.with(7, 1e-31) },
    /control point 1 is 1e-31, expected at least 1e-30/,
  ],
  ["KNOTS_DECREASING", { knotsU: [0, 1, 0, 1] }],
  ["KNOTS_LENGTH", { knotsV: [0, 0, 1] }, /3 knots in v, expected 4/],
  [
    "KNOTS_MULTIPLICITY",
    { knotsU: [0, 0, 0, 1, 1], counts: [3, 2], controlPoints: Array(24).fill(1) },
  ],
  ["KNOTS_EMPTY_DOMAIN", { knotsU: [0, 1, 1, 2] }],
  [
    "RAGGED_NET",
    { controlPoints: square().controlPoints.slice(4) },
    /3 control points, expected 4/,
  ],
  ["TOO_FEW_CONTROL_POINTS", { counts: [1, 2] }],
  ["DEGREE_OUT_OF_RANGE", { degree: [0, 1] }],
  ["DEGREE_OUT_OF_RANGE", { degree: [1, 16] }, /degree 16 in v, expected 1 to 15/],
  ["ARGUMENT_INVALID", { degree: [1, 2 ** 32 + 1] }],
  ["ARGUMENT_INVALID", { degree: [1.5, 1] }],
  ["ARGUMENT_INVALID", { degree: [1, 1, 1] }],
  ["ARGUMENT_INVALID", { counts: "22" }],
  ["ARGUMENT_INVALID", { counts: [2, -2] }],
  ["ARGUMENT_INVALID", { knotsU: undefined }, /surface 0: knotsU is undefined/],
  ["ARGUMENT_INVALID", { knotsU: [0, 0, "1", 1] }, /knotsU: item 2 is string/],
  ["ARGUMENT_INVALID", { knotsV: { length: 4 } }],
  ["ARGUMENT_INVALID", { controlPoints: new Float64Array(15) }, /four a point/],
];

for (const [code, change, message] of refusals) {
  const name = Object.keys(change).join(", ");
  test(`arrays with wrong ${name} are refused: ${code}`, () => {
    assert.throws(() => hd.model([{ ...square(), ...change }]), withCode(code, message));
  });
}

const misspelt = [
  [{ homogenous: true }, /surface 0: found "homogenous", did you mean "homogeneous"\?/],
  [{ knots_u: [0, 0, 1, 1] }, /surface 0: found "knots_u", did you mean "knotsU"\?/],
  [{ ctrl: [] }, /surface 0: found "ctrl", expected one of degree, knotsU/],
  [{ trim: [[{ degre: 1 }]] }, /surface 0, loop 0, curve 0: found "degre", did you mean "degree"/],
];

for (const [change, message] of misspelt) {
  test(`arrays with ${Object.keys(change)} are refused`, () => {
    const input = [{ ...square(), ...change }];
    assert.throws(() => hd.model(input), withCode("ARGUMENT_INVALID", message));
  });
}

test("unknown keys of a model and of its instances are refused", () => {
  const model = { surfaces: [square()], units: 0.001 };
  assert.throws(
    () => hd.model(model),
    withCode("ARGUMENT_INVALID", /"units", did you mean "unit"/),
  );
  const instances = [{ surface: [0], transform: Array(12).fill(0) }];
  assert.throws(
    () => hd.model({ surfaces: [square()], instances }),
    withCode("ARGUMENT_INVALID", /instance 0: found "surface", did you mean "surfaces"/),
  );
});

test("keys of plain arrays in interchange JSON are refused, as each format has one spelling", () => {
  for (const change of [{ homogeneous: true }, { knotsU: [0, 0, 1, 1] }, { counts: [2, 2] }]) {
    const model = changed(change);
    assert.throws(() => hd.model(model), withCode("ARGUMENT_INVALID", /in interchange JSON/));
  }
});

test("files are for readCad", () => {
  const texts = ["ISO-10303-21;\nHEADER;", "DBRep_DrawableShape\n", `${"x".repeat(72)}S      1\n`];
  const inputs = [...texts, new Uint8Array(8), new ArrayBuffer(8), { brep: texts[1] }];
  for (const input of inputs) {
    assert.throws(() => hd.model(input), withCode("ARGUMENT_INVALID", /hd\.readCad/));
  }
});

test("errors name the surface", () => {
  assert.throws(
    () => hd.model([square(), square(), { ...square(), degree: [1, 99] }]),
    withCode("DEGREE_OUT_OF_RANGE", /surface 2/),
  );
});

test("what is no model is refused", () => {
  assert.throws(() => hd.model([]), withCode("EMPTY_MODEL"));
  assert.throws(() => hd.model([null]), withCode("ARGUMENT_INVALID", /surface 0 is null/));
  for (const input of [undefined, null, 1, () => 1]) {
    assert.throws(() => hd.model(input), withCode("ARGUMENT_INVALID"));
  }
});

const shapes = [
  ["no JSON", "{"],
  ["no object", "[]"],
  ["null", "null"],
  ["no surfaces", {}],
  ["surfaces that are no array", { surfaces: {} }],
  ["a surface that is no object", { surfaces: [1] }],
  ["a name that is no string", { ...interchangeSquare(), name: 1 }],
  ["no degree", changed({ degree: undefined })],
  ["one degree", changed({ degree: [1] })],
  ["knots of another type", changed({ knots_u: [0, 0, "1", 1] })],
  ["no knots", changed({ knots_v: null })],
  ["a net of one dimension", changed({ ctrl: [[0, 0, 0, 1]] })],
  ["points without weights", changed({ ctrl: [[[0, 0, 0]]] })],
  ["points of five numbers", changed({ ctrl: [[[0, 0, 0, 1, 1]]] })],
];

function changed(change) {
  const model = interchangeSquare();
  Object.assign(model.surfaces[0], change);
  return model;
}

for (const [name, input] of shapes) {
  test(`JSON of another shape is refused: ${name}`, () => {
    assert.throws(() => hd.model(input), withCode("JSON_SHAPE", /not interchange JSON/));
  });
}

test("the place in the JSON is named", () => {
  const ctrl = interchangeSquare().surfaces[0].ctrl;
  ctrl[1][0] = [1, 0, 0, "1"];
  assert.throws(
    () => hd.model(changed({ ctrl })),
    withCode(
      "JSON_SHAPE",
      /surfaces\[0\]\.ctrl\[1\]\[0\]\[3\]: invalid type: string "1", expected a number/,
    ),
  );
});

test("ragged JSON nets are refused as in Rust", () => {
  const ctrl = interchangeSquare().surfaces[0].ctrl;
  ctrl[1].pop();
  assert.throws(
    () => hd.model(changed({ ctrl })),
    withCode("RAGGED_NET", /^surface 0: row 1 of the net has 1 control points, expected 2$/),
  );
});

test("numbers of JSON are checked by the module", () => {
  // JSON has no NaN: as in a text it is null.
  assert.throws(
    () => hd.model(changed({ knots_u: [0, 0, Number.NaN, 1] })),
    withCode("JSON_SHAPE", /surfaces\[0\]\.knots_u\[2\]: invalid type: null, expected a number/),
  );
  assert.throws(() => hd.model(changed({ knots_u: [0, 1, 0, 1] })), withCode("KNOTS_DECREASING"));
  assert.throws(() => hd.model({ surfaces: [] }), withCode("EMPTY_MODEL"));
});

test("texts over the limit are refused", () => {
  assert.throws(
    () => hd.model(" ".repeat(256 * 2 ** 20 + 1)),
    withCode("FILE_TOO_LARGE", /268435457 bytes, expected at most 268435456/),
  );
});

test("an unknown shape is refused, naming those there are", () => {
  assert.throws(() => hd.shape("teapot"), withCode("UNKNOWN_SHAPE", /sphere/));
  assert.throws(() => hd.shape(undefined), withCode("UNKNOWN_SHAPE"));
});
