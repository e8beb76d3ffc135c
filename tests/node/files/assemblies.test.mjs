// Names and colours of the faces of assemblies.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { facePath } from "nurbs-hausdorff";
import { convertCad } from "nurbs-hausdorff/cad";
import { Hausdorff } from "nurbs-hausdorff/worker";
import { stepAssembly } from "../../page/support/models.mjs";
import { createBoth, interchangeSquare, square, withCode } from "../support.mjs";
import { bytesOf } from "./files.mjs";

let away;
let direct;
before(async () => {
  [away, direct] = await createBoth(Hausdorff);
});
after(() => {
  away.dispose();
  direct.dispose();
});

const facesOf = (model) => Array.from({ length: model.faceCount }, (_, face) => face);

/** The names of all levels, in the order of the file. */
const PATHS = ["pump", "pump (spare)"].flatMap((pump) =>
  ["in / out", "in / out (2)"].flatMap((valve) =>
    ["low", "high"].map((face) => ["machine", pump, valve, face]),
  ),
);

test("faces have the names of all levels of their assembly, and their colours", async () => {
  const file = bytesOf(stepAssembly({ color: ["0.25", "0.5", "1."] }));
  for (const hd of [direct, away]) {
    const model = await hd.readCad(file);
    const faces = facesOf(model);
    assert.deepEqual(
      faces.map((face) => facePath(model.faceName(face))),
      PATHS,
    );
    assert.equal(model.faceName(1), "machine / pump / in // out / high");
    assert.deepEqual(
      faces.map((face) => model.faceColor(face)),
      faces.map((face) => (face % 2 === 0 ? [0.25, 0.5, 1] : null)),
    );
    assert.equal(model.faceColor(faces.length), null);
    model.dispose();
  }
});

test("a result names the face by all levels", async () => {
  const a = await direct.readCad(bytesOf(stepAssembly()));
  const b = direct.model([square(3)]);
  const { facesOfA } = await direct.diff(a, b, { limit: 1 });
  assert.deepEqual(
    facesOfA.map(({ witness }) => facePath(witness.a.faceName)),
    PATHS,
  );
  a.dispose();
  b.dispose();
});

test("interchange JSON and arrays keep names and colours", async () => {
  const { json: converted } = await convertCad(
    bytesOf(stepAssembly({ color: ["1.", "0.5", "0."] })),
  );
  const again = direct.model(converted);
  assert.deepEqual(facePath(again.faceName(7)), PATHS[7]);
  assert.deepEqual([again.faceColor(0), again.faceColor(1)], [[1, 0.5, 0], null]);
  again.dispose();
  const colored = direct.model([{ ...square(), color: [0, 0.125, 1] }, square(1)]);
  assert.deepEqual([colored.faceColor(0), colored.faceColor(1)], [[0, 0.125, 1], null]);
  colored.dispose();
  for (const color of [
    [0, 0],
    [0, 0, 1.5],
    [0, -1, 0],
    [Number.NaN, 0, 0],
  ]) {
    const wrong = () => direct.model([{ ...square(), color }]);
    assert.throws(wrong, withCode("OPTION_OUT_OF_RANGE", /color/));
  }
  const [surface] = interchangeSquare().surfaces;
  const wrong = () => direct.model({ surfaces: [{ ...surface, color: [0, 0, 2] }] });
  assert.throws(wrong, withCode("OPTION_OUT_OF_RANGE", /color/));
});
