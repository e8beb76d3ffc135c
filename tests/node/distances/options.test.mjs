import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, square, withCode } from "../support.mjs";

let hd;
let a;
before(async () => {
  hd = await create({ backend: "cpu" });
  a = hd.model([square()]);
});
after(() => {
  a.dispose();
  hd.dispose();
});

const refusals = [
  [
    "OPTION_INVALID",
    { samples: 8 },
    /samples is an option of method iteration and of deviations, found method certified/,
  ],
  [
    "OPTION_INVALID",
    { iterations: 8 },
    /iterations is an option of method iteration, found method certified/,
  ],
  ["OPTION_INVALID", { method: "iteration", grid: 8 }, /grid is an option of method hierarchy/],
  [
    "OPTION_INVALID",
    { method: "hierarchy", maxCells: 8 },
    /maxCells is an option of method certified/,
  ],
  ["OPTION_INVALID", { tolerance: null }, /tolerance: found null/],
  ["OPTION_OUT_OF_RANGE", { method: "iteration", samples: 1 }, /samples is 1, expected 2 to 1024/],
  ["OPTION_OUT_OF_RANGE", { method: "iteration", samples: 1025 }],
  ["OPTION_OUT_OF_RANGE", { method: "iteration", iterations: 0 }],
  ["OPTION_OUT_OF_RANGE", { method: "iteration", iterations: 1001 }],
  ["OPTION_OUT_OF_RANGE", { method: "iteration", stepTolerance: 0 }],
  ["OPTION_OUT_OF_RANGE", { method: "iteration", stepTolerance: Number.NaN }],
  ["OPTION_OUT_OF_RANGE", { tolerance: -1 }],
  ["OPTION_OUT_OF_RANGE", { relativeTolerance: 0 }],
  ["OPTION_INVALID", { tolerance: 1, relativeTolerance: 1e-3 }],
  ["OPTION_OUT_OF_RANGE", { method: "hierarchy", grid: 1 }, /grid is 1, expected 2 to 1024/],
  ["OPTION_OUT_OF_RANGE", { method: "hierarchy", memoryBudget: 0 }, /1 to 256 MiB/],
  [
    "OPTION_INVALID",
    { method: "iteration", samples: 2.5 },
    /samples: .*`2.5`, expected an integer from 0/,
  ],
  [
    "OPTION_INVALID",
    { method: "iteration", samples: -1 },
    /samples: .*`-1.0`, expected an integer from 0/,
  ],
  [
    "OPTION_INVALID",
    { method: "iteration", samples: "64" },
    /samples: .*string "64", expected an integer from 0/,
  ],
  ["OPTION_INVALID", { method: "iteration", samples: null }, /samples: /],
  ["OPTION_INVALID", { sample: 64 }, /unknown name "sample", did you mean "samples"\?/],
  ["OPTION_INVALID", { method: "guess" }, /method: unknown variant `guess`, .*`certified`/],
  ["OPTION_INVALID", { method: "iteration", flatness: "flat" }, /flatness: .*`curvature`/],
  ["OPTION_INVALID", { method: "iteration", sampling: 1 }, /sampling: /],
  ["OPTION_INVALID", { method: "iteration", projection: {} }],
  ["OPTION_INVALID", { method: "iteration", culling: true }],
  ["OPTION_INVALID", { symmetric: "yes" }, /symmetric: .*"yes", expected a boolean/],
  ["OPTION_INVALID", { backend: "tpu" }, /backend: .*`tpu`.*`auto`/],
  ["OPTION_INVALID", { deviations: 1 }, /deviations: .*expected a boolean/],
  ["OPTION_INVALID", { limit: "1" }, /limit: .*expected a number/],
  ["OPTION_INVALID", { maxSeconds: [] }, /maxSeconds: /],
  ["OPTION_INVALID", { max_seconds: 1 }, /unknown name "max_seconds", did you mean "maxSeconds"\?/],
  ["OPTION_INVALID", { signal: {} }],
  ["OPTION_INVALID", { signal: null }],
  ["OPTION_INVALID", { onProgress: 1 }],
  ["OPTION_INVALID", { transform: 1 }, /transform: found .*expected an object/],
  ["OPTION_INVALID", { transform: { translate: [0, 0, 0] } }, /did you mean "translation"\?/],
  ["OPTION_INVALID", { transform: null }, /transform: found null, expected an object/],
  ["OPTION_INVALID", { transform: { translation: [0, 0] } }, /transform: translation.*3 numbers/],
  [
    "OPTION_INVALID",
    { transform: { rotation: [0, 0, 0, 1, 0] } },
    /transform: rotation.*4 numbers/,
  ],
  ["OPTION_INVALID", { transform: { rotation: [0, 0, 0, "1"] } }],
  ["TRANSFORM_NOT_RIGID", { transform: { rotation: [0, 0, 0, 2] } }],
  ["TRANSFORM_NOT_RIGID", { transform: { translation: [0, 0, Infinity] } }],
  ["TRANSFORM_NOT_RIGID", { transform: { translation: [0, 0, 2e100] } }],
];

for (const [code, options, message] of refusals) {
  test(`${code}: ${Object.keys(options)} ${JSON.stringify(Object.values(options))}`, async () => {
    await assert.rejects(hd.distance(a, a, options), withCode(code, message));
  });
}

test("unknown options of every method are refused, and the nearest named", async () => {
  const points = new Float64Array(3);
  for (const [run, options, nearest] of [
    [(options) => create(options), { backnd: "cpu" }, "backend"],
    [(options) => hd.field(a, a, options), { sample: 8 }, "samples"],
    [(options) => hd.diff(a, a, options), { limits: 1 }, "limit"],
    [(options) => hd.closestPoints(a, points, options), { toleranc: 1 }, "tolerance"],
    [(options) => hd.bestFit(a, a, options), { maxStep: 1 }, "maxSteps"],
    [async (options) => a.tessellate(options), { relativetolerance: 1 }, "relativeTolerance"],
    [async (options) => a.update(0, points, options), { homogenous: true }, "homogeneous"],
    [(options) => hd.readCad(new Uint8Array(1), options), { units: 1 }, "unit"],
  ]) {
    const message = new RegExp(`did you mean "${nearest}"`);
    await assert.rejects(run(options), withCode("OPTION_INVALID", message));
  }
});

test("options that are no object are refused", async () => {
  for (const options of [null, 1, "fast"]) {
    await assert.rejects(hd.distance(a, a, options), withCode("OPTION_INVALID"));
  }
});

test("undefined options have their defaults", async () => {
  const { samples } = await hd.distance(a, a, {
    method: "iteration",
    samples: undefined,
    transform: undefined,
    signal: undefined,
    onProgress: undefined,
  });
  assert.equal(samples, 64 * 64);
});

test("what is no model is refused", async () => {
  await assert.rejects(hd.distance(a, {}), withCode("ARGUMENT_INVALID", /b is not a NurbsModel/));
  await assert.rejects(hd.distance(undefined, a), withCode("ARGUMENT_INVALID", /a is not/));
});
