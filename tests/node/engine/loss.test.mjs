// A device that goes away, as when a driver is reset.
import assert from "node:assert/strict";
import { test } from "node:test";
import { create, near, withCode } from "../support.mjs";

/** The devices handed out while `run` runs. */
async function devices(run) {
  const made = [];
  const { gpu } = navigator;
  const requestAdapter = async (...options) => {
    const adapter = await gpu.requestAdapter(...options);
    const requestDevice = adapter.requestDevice.bind(adapter);
    adapter.requestDevice = async (descriptor) => {
      const device = await requestDevice(descriptor);
      made.push(device);
      return device;
    };
    return adapter;
  };
  navigator.gpu = { requestAdapter };
  try {
    await run(made);
  } finally {
    navigator.gpu = gpu;
  }
}

const options = { method: "iteration", samples: 16 };

test("after a lost device a new one is used, after two the CPU", async () => {
  await devices(async (made) => {
    const hd = await create();
    const a = hd.shape("sphere");
    const b = hd.shape("sphere-larger");
    assert.equal(made.length, 1);
    made[0].destroy();
    await made[0].lost;
    const second = await hd.distance(a, b, options);
    near(second.computed, 0.2, 1e-12);
    assert.equal(second.backend, "gpu");
    assert.equal(made.length, 2);
    made[1].destroy();
    await made[1].lost;
    const third = await hd.distance(a, b, options);
    near(third.computed, 0.2, 1e-12);
    assert.equal(third.backend, "cpu");
    assert.match(third.notice, /lost: 2 times/);
    assert.equal(hd.backend, "cpu");
  });
});

test("a device lost in the middle of the work is replaced, and progress does not fall", async () => {
  await devices(async (made) => {
    const hd = await create();
    const a = hd.shape("wavy-sheet");
    const b = hd.shape("wavy-sheet-b");
    const seen = [];
    const onProgress = (fraction) => {
      seen.push(fraction);
      if (fraction > 0.1 && made.length === 1) made[0].destroy();
    };
    const result = await hd.distance(a, b, { method: "iteration", samples: 256, onProgress });
    assert.equal(result.backend, "gpu");
    assert.equal(made.length, 2);
    assert.ok(seen.every((fraction, index) => index === 0 || fraction >= seen[index - 1]));
  });
});

test("with backend gpu the second loss is an error", async () => {
  await devices(async (made) => {
    const hd = await create({ backend: "gpu" });
    const a = hd.shape("sphere");
    made[0].destroy();
    await made[0].lost;
    await hd.distance(a, a, { ...options, backend: "gpu" });
    made[1].destroy();
    await made[1].lost;
    await assert.rejects(
      hd.distance(a, a, { ...options, backend: "gpu" }),
      withCode("DEVICE_LOST"),
    );
  });
});
