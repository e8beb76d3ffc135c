import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, square, withCode } from "../support.mjs";

let hd;
before(async () => {
  hd = await create();
});
after(() => hd.dispose());

const states = (faces) => faces.map(({ state }) => state);

test("the raised one of two squares is the face that changed", async () => {
  const a = hd.model([square(0), square(7)]);
  const b = hd.model([square(0), square(7.5)]);
  const fractions = [];
  const result = await hd.diff(a, b, { limit: 0.01, onProgress: (f) => fractions.push(f) });
  assert.equal(result.state, "changed");
  assert.equal(result.limit, 0.01);
  assert.deepEqual(states(result.facesOfA), ["unchanged", "changed"]);
  assert.deepEqual(states(result.facesOfB), ["unchanged", "changed"]);
  const { lower, upper, face, witness } = result.facesOfA[1];
  assert.ok(lower <= 0.5 && 0.5 <= upper && upper - lower <= 0.5e-3);
  assert.equal(face, 1);
  assert.equal(witness.a.point[2], 7);
  assert.equal(witness.b.point[2], 7.5);
  assert.equal(fractions.at(-1), 1);
  a.dispose();
  b.dispose();
});

test("moved back, nothing changed", async () => {
  const a = hd.model([square(2)]);
  const b = hd.model([square(0)]);
  const moved = await hd.diff(a, b, { transform: { translation: [0, 0, -2] } });
  assert.equal(moved.state, "unchanged");
  assert.equal((await hd.diff(a, b)).state, "changed");
  a.dispose();
  b.dispose();
});

test("a wrong option is refused by its name", async () => {
  const a = hd.model([square(0)]);
  await assert.rejects(hd.diff(a, a, { limit: 0 }), withCode("OPTION_OUT_OF_RANGE", /limit/));
  await assert.rejects(hd.diff(a, a, { samples: 4 }), withCode("OPTION_INVALID", /samples/));
  const signal = AbortSignal.abort("why");
  await assert.rejects(hd.diff(a, a, { signal }), withCode("CANCELLED"));
  a.dispose();
});
