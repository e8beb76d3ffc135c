// `readCad` of the class of `nurbs-hausdorff/worker`: files read in the worker.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { fromOcct } from "nurbs-hausdorff/adapters";
import { Hausdorff, NurbsModel } from "nurbs-hausdorff/worker";
import { stepSquares } from "../../page/support/models.mjs";
import { createBoth, givesWay, interchangeSquare, withCode } from "../support.mjs";
import { missing, sharedGzip } from "./files.mjs";

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
  const model = await hd.readCad(text(interchangeSquare()));
  assert.ok(model instanceof NurbsModel);
  assert.equal(model.name, "square");
  assert.equal(model.report.kind, "json");
  const { lower, upper } = await hd.distance(model, await hd.model(interchangeSquare(0.5)));
  assert.ok(lower <= 0.5 && 0.5 <= upper);
});

test("a file's buffer is transferred on request only", async () => {
  const kept = text(interchangeSquare());
  await hd.readCad(kept);
  assert.ok(kept.length > 0);
  await hd.readCad(kept, { transfer: true });
  assert.equal(kept.length, 0);
});

test("the faces of a file are told as the main thread's reader tells them", async () => {
  const told = async (engine) => {
    const faces = [];
    await engine.readCad(new TextEncoder().encode(stepSquares(2)), {
      onFace: (face) => faces.push(face),
    });
    return faces;
  };
  const [own, worker] = [await told(direct), await told(hd)];
  assert.equal(own.length, 4);
  assert.deepEqual(worker, own);
});

test("errors have the codes of the main thread's reader", async () => {
  await assert.rejects(
    hd.readCad(new TextEncoder().encode("solid cube")),
    withCode("FORMAT_UNSUPPORTED", /an STL file/),
  );
  await assert.rejects(hd.readCad(3), withCode("ARGUMENT_INVALID"));
  await assert.rejects(hd.readCad(text({}), { units: 1 }), withCode("OPTION_INVALID", /"unit"/));
  await assert.rejects(
    hd.readCad(text({}), { rhino: () => ({}) }),
    withCode("OPTION_INVALID", /rhino is function.*address/),
  );
});

test("an aborted signal ends the reading of a file, here at once, and the worker goes on", async () => {
  const reason = new Error("enough");
  const cancelled = (error) => withCode("CANCELLED")(error) && error.cause === reason;
  for (const engine of [hd, direct]) {
    const controller = new AbortController();
    const { signal } = controller;
    const order = [];
    const reads = [
      engine.readCad(text(interchangeSquare()), { signal }),
      engine.readMesh(new TextEncoder().encode("0 0 0\n"), "xyz", { signal }),
    ].map((read) =>
      assert.rejects(read, cancelled).then(() => {
        order.push("cancelled");
      }),
    );
    const next = engine.readCad(text(interchangeSquare())).then(() => {
      order.push("next");
    });
    controller.abort(reason);
    await Promise.all([...reads, next]);
    if (engine === hd) assert.deepEqual(order, ["cancelled", "cancelled", "next"]);
    await assert.rejects(engine.readCad(text({}), { signal }), cancelled);
    await assert.rejects(engine.readCad(text({}), { signal: 1 }), withCode("OPTION_INVALID"));
  }
});

test("a STEP file is read without blocking the caller", { skip: missing }, async () => {
  const step = sharedGzip("step/linkrods.step");
  const expected = await direct.readCad(step, { name: "linkrods" });
  let model;
  await givesWay(async () => {
    model = await hd.readCad(step, { name: "linkrods" });
  });
  assert.deepEqual(model.report, expected.report);
  assert.equal(model.report.reader, "built-in");
  assert.deepEqual(model.boundingBox, expected.boundingBox);
  assert.equal(model.faceCount, expected.faceCount);
});

test("libraries come by their addresses", { skip: missing }, async () => {
  const address = new URL(import.meta.resolve("rhino3dm"));
  const libraries = [];
  const onLibrary = (library) => libraries.push(library);
  for (const rhino of [address, address.href, "rhino3dm"]) {
    const { report } = await hd.readCad(sharedGzip("3dm/v4_MechPartB.3dm"), { rhino, onLibrary });
    assert.deepEqual([report.reader, report.faces], ["rhino3dm", 14]);
  }
  assert.deepEqual(libraries, ["rhino", "rhino"], "equal addresses are one");
});

test("a shape in memory is sent as its text", async () => {
  const { default: start } = await import("@bitbybit-dev/occt/bitbybit-dev-occt/node.js");
  const oc = await start();
  const box = fromOcct(oc, new oc.BRepPrimAPI_MakeBox_2(1, 2, 3).Shape());
  const model = await hd.readCad(box, { name: "box" });
  assert.deepEqual([model.name, model.unit, model.faceCount], ["box", 0.001, 6]);
});
