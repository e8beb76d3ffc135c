// The entry `nurbs-hausdorff/worker/cad`: files read in the worker.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import * as cad from "nurbs-hausdorff/cad";
import { Hausdorff, NurbsModel, readCad } from "nurbs-hausdorff/worker/cad";
import { missing, sharedGzip } from "../files/files.mjs";
import { blocksAtMost, createBoth, interchangeSquare, withCode } from "../support.mjs";

let hd;
let direct;
before(async () => {
  [hd, direct] = await createBoth(Hausdorff);
});
after(() => {
  hd.dispose();
  direct.dispose();
});

const text = (model) => new TextEncoder().encode(JSON.stringify(model));

test("interchange JSON becomes a model of the worker, with its report", async () => {
  const model = await readCad(hd, text(interchangeSquare()));
  assert.ok(model instanceof NurbsModel);
  assert.equal(model.name, "square");
  assert.equal(model.report.kind, "json");
  const { lower, upper } = await hd.distance(model, await hd.model(interchangeSquare(0.5)));
  assert.ok(lower <= 0.5 && 0.5 <= upper);
});

test("a file's buffer is transferred on request only", async () => {
  const kept = text(interchangeSquare());
  await readCad(hd, kept);
  assert.ok(kept.length > 0);
  await readCad(hd, kept, { transfer: true });
  assert.equal(kept.length, 0);
});

test("errors have the codes of the main thread's reader", async () => {
  await assert.rejects(
    readCad(hd, new TextEncoder().encode("solid cube")),
    withCode("FORMAT_UNSUPPORTED", /an STL file/),
  );
  await assert.rejects(readCad({}, text({})), withCode("ARGUMENT_INVALID"));
  await assert.rejects(readCad(hd, 3), withCode("ARGUMENT_INVALID"));
});

test("a STEP file is read without blocking the caller", { skip: missing }, async () => {
  const step = sharedGzip("step/linkrods.step");
  const expected = await cad.readCad(step, { name: "linkrods" });
  let model;
  await blocksAtMost(50, async () => {
    model = await readCad(hd, step, { name: "linkrods" });
  });
  assert.deepEqual(model.report, expected.report);
  assert.deepEqual(model.boundingBox, expected.boundingBox);
  assert.equal(model.faceCount, expected.faceCount);
});
