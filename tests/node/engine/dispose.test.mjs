import assert from "node:assert/strict";
import { test } from "node:test";
import { create, near, square, withCode } from "../support.mjs";

test("a model that was disposed of says so", async () => {
  const hd = await create({ backend: "cpu" });
  const model = hd.model([square()]);
  const other = hd.model([square()]);
  model.dispose();
  model.dispose();
  for (const use of [
    () => model.name,
    () => model.faceCount,
    () => model.boundingBox,
    () => model.tessellate(),
  ]) {
    assert.throws(use, withCode("DISPOSED"));
  }
  await assert.rejects(hd.distance(model, other), withCode("DISPOSED"));
  await assert.rejects(hd.distance(other, model), withCode("DISPOSED"));
});

test("an engine that was disposed of says so", async () => {
  const hd = await create({ backend: "cpu" });
  const model = hd.model([square()]);
  hd.dispose();
  hd.dispose();
  for (const use of [() => hd.backend, () => hd.adapter, () => hd.notice]) {
    assert.throws(use, withCode("DISPOSED"));
  }
  await assert.rejects(hd.distance(model, model), withCode("DISPOSED"));
  // Models outlive it, and need none.
  assert.equal(model.faceCount, 1);
  assert.equal(hd.model([square()]).faceCount, 1);
  assert.equal(hd.shape("sphere").faceCount, model.faceCount);
});

test("Symbol.dispose, which `using` calls, disposes", async () => {
  const hd = await create({ backend: "cpu" });
  const model = hd.model([square()]);
  model[Symbol.dispose]();
  assert.throws(() => model.name, withCode("DISPOSED"));
  hd[Symbol.dispose]();
  assert.throws(() => hd.backend, withCode("DISPOSED"));
});

test("work outlives the disposal of all that it uses", async () => {
  const hd = await create();
  const a = hd.shape("sphere");
  const b = hd.shape("sphere-larger");
  const options = { method: "iteration", samples: 16 };
  const results = [hd.distance(a, b, options), hd.distance(b, a, options)];
  for (const disposable of [a, b, hd]) disposable.dispose();
  for (const { computed } of await Promise.all(results)) near(computed, 0.2, 1e-12);
});

test("models do not belong to the engine that made them", async () => {
  const gpu = await create();
  const cpu = await create({ backend: "cpu" });
  const model = cpu.model([square(0)]);
  const other = gpu.model([square(2)]);
  for (const hd of [gpu, cpu]) {
    near((await hd.distance(model, other, { method: "iteration" })).computed, 2, 1e-12);
  }
});
