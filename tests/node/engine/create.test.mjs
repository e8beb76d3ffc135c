import assert from "node:assert/strict";
import { test } from "node:test";
import { Hausdorff } from "nurbs-hausdorff";
import { create, withCode } from "../support.mjs";

test("nothing works before the module is loaded", () => {
  assert.throws(() => Hausdorff.shapes(), withCode("MODULE_NOT_LOADED"));
});

test("a failed load can be tried again", async () => {
  await assert.rejects(Hausdorff.create({ module: new Uint8Array([0, 1, 2, 3]) }), (error) => {
    assert.ok(error.cause instanceof WebAssembly.CompileError);
    return withCode("MODULE_FAILED", /inline/)(error);
  });
  const missing = new URL("file:///no-such-folder/module.wasm");
  await assert.rejects(Hausdorff.create({ module: missing }), withCode("MODULE_FAILED"));
  const hd = await create({ backend: "cpu" });
  assert.equal(hd.backend, "cpu");
});

test("the GPU is found and named", async () => {
  const hd = await create();
  assert.equal(hd.backend, "gpu");
  assert.match(hd.adapter, /llvmpipe/);
  assert.equal(hd.notice, null);
});

test("the CPU can be requested", async () => {
  const hd = await create({ backend: "cpu" });
  assert.equal(hd.backend, "cpu");
  assert.equal(hd.adapter, null);
  assert.equal(hd.notice, null);
});

test("an unknown backend is refused", async () => {
  await assert.rejects(create({ backend: "tpu" }), withCode("OPTION_INVALID", /auto/));
  await assert.rejects(create({ backend: 1 }), withCode("OPTION_INVALID"));
});

test("without an adapter the CPU is used, and asking for the GPU fails", async () => {
  const { gpu } = navigator;
  navigator.gpu = { requestAdapter: async () => null };
  try {
    const hd = await create();
    assert.equal(hd.backend, "cpu");
    assert.match(hd.notice, /computed on the CPU/);
    const sphere = hd.shape("sphere");
    const result = await hd.distance(sphere, sphere, { method: "iteration", samples: 4 });
    assert.equal(result.backend, "cpu");
    assert.equal(result.notice, hd.notice);
    await assert.rejects(create({ backend: "gpu" }), withCode("NO_ADAPTER"));
    await assert.rejects(
      hd.distance(sphere, sphere, { method: "iteration", backend: "gpu" }),
      withCode("NO_ADAPTER"),
    );
  } finally {
    navigator.gpu = gpu;
  }
});

test("several at once share one module", async () => {
  const made = await Promise.all([create(), create({ backend: "cpu" }), create()]);
  assert.deepEqual(
    made.map((hd) => hd.backend),
    ["gpu", "cpu", "gpu"],
  );
  for (const hd of made) hd.dispose();
});
