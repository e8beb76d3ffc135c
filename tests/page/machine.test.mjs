// Machines that lack something.
import assert from "node:assert/strict";
import { test } from "node:test";
import { open } from "./open.mjs";

async function on(machine, run) {
  const opened = await open(machine);
  try {
    await run(opened);
    assert.deepEqual(opened.errors, []);
  } finally {
    await opened.close();
  }
}

test("without WebGPU it says so and runs on the CPU, on a narrow screen too", () =>
  on({ webgpu: false, size: { width: 400, height: 800 } }, async (narrow) => {
    await narrow.page.locator('#result[data-state="done"]').waitFor();
    assert.match(await narrow.page.locator("#banner").textContent(), /No WebGPU/);
    await narrow.until("done", () => narrow.page.selectOption("#method", "iteration"));
    assert.match((await narrow.texts("#facts")).time, /on the CPU/);
    const sizes = () => [document.documentElement.scrollWidth, innerWidth];
    const [content, window] = await narrow.page.evaluate(sizes);
    assert.ok(content <= window, `${content} pixels on ${window}`);
    await narrow.screenshot("narrow-cpu");
    await narrow.page.locator("#dismiss").click();
    assert.ok(await narrow.page.locator("#banner").isHidden());
  }));

test("without WebGL it says so, and the numbers come all the same", () =>
  on({ webgpu: false, webgl: false }, async ({ page, until, data, screenshot }) => {
    await page.locator('#result[data-state="done"]').waitFor();
    assert.match(await page.locator("#banner").textContent(), /No WebGL/);
    assert.ok(await page.locator("#tools").isHidden());
    await until("done", () => page.selectOption("#preset", { label: "Concentric spheres" }));
    const { lower, upper } = await data();
    assert.ok(Number(lower) <= 0.2 + 1e-12 && 0.2 - 1e-12 <= Number(upper), `${lower} ${upper}`);
    await screenshot("no-webgl");
  }));

test("a module that cannot be loaded is told, not awaited for ever", () =>
  on(
    { prepare: (page) => page.route("**/*.wasm", (route) => route.abort()) },
    async ({ page, screenshot }) => {
      await page.locator('#result[data-state="failed"]').waitFor();
      assert.match(await page.locator("#error").textContent(), /^UNEXPECTED: ./);
      assert.equal(await page.locator("#interval").textContent(), "failed");
      await screenshot("no-module");
    },
  ));
