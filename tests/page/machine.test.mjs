// Machines without WebGPU, without WebGL, or with a failing GPU.
import assert from "node:assert/strict";
import { test } from "node:test";
import { open } from "./support/open.mjs";

async function on(machine, run) {
  const opened = await open(machine);
  try {
    await run(opened);
    assert.deepEqual(opened.errors, []);
  } finally {
    await opened.close();
  }
}

test("without WebGPU the details say so, and every method runs on the CPU, on a narrow screen too", () =>
  on({ webgpu: false, size: { width: 400, height: 800 } }, async (narrow) => {
    await narrow.page.locator('#result[data-state="done"]').waitFor();
    assert.match(await narrow.page.locator("#engine").textContent(), /CPU, float64: ./);
    for (const method of ["iteration", "hierarchy"]) {
      await narrow.until("done", () => narrow.page.selectOption("#method", method));
      assert.match((await narrow.texts("#facts")).time, /on the CPU/);
      assert.ok(await narrow.page.locator("#banner").isHidden(), "it only takes longer");
    }
    const sizes = () => [document.documentElement.scrollWidth, innerWidth];
    const [content, window] = await narrow.page.evaluate(sizes);
    assert.ok(content <= window, `${content} pixels on ${window}`);
    await narrow.screenshot("narrow-cpu");
  }));

test("without WebGL a warning says so, and distances are still computed", () =>
  on({ webgpu: false, webgl: false }, async ({ page, until, data, screenshot }) => {
    await page.locator('#result[data-state="done"]').waitFor();
    assert.match(await page.locator("#banner").textContent(), /No WebGL/);
    assert.ok(await page.locator("#tools").isHidden());
    await until("done", () => page.selectOption("#preset", { label: "Concentric spheres" }));
    const { lower, upper } = await data();
    assert.ok(Number(lower) <= 0.2 + 1e-12 && 0.2 - 1e-12 <= Number(upper), `${lower} ${upper}`);
    await screenshot("no-webgl");
  }));

test("a module that cannot be loaded is reported, and ends the waiting", () =>
  on(
    { prepare: (page) => page.route("**/*.wasm", (route) => route.abort()) },
    async ({ page, screenshot }) => {
      await page.locator('#result[data-state="failed"]').waitFor();
      assert.match(await page.locator("#error").textContent(), /.\(MODULE_FAILED\)$/);
      assert.equal(await page.locator("#interval").textContent(), "failed");
      await screenshot("no-module");
    },
  ));

test("with WebGPU the methods of samples and boxes run on the GPU, without a warning", () =>
  on({}, async ({ page, until, texts }) => {
    await page.locator('#result[data-state="done"]').waitFor();
    for (const method of ["iteration", "hierarchy"]) {
      await until("done", () => page.selectOption("#method", method));
      assert.match((await texts("#facts")).time, /on the GPU/);
      assert.ok(await page.locator("#banner").isHidden());
    }
  }));

/** Gives the results of method `hierarchy` a notice, as if the GPU had failed on the way. */
const failHierarchy = (page) =>
  page.addInitScript(() => {
    globalThis.Worker = class extends Worker {
      set onmessage(listener) {
        super.onmessage = ({ data }) => {
          if (data.result?.method === "hierarchy") data.result.notice = "failed on purpose";
          listener({ data });
        };
      }
    };
  });

test("the notice of one distance is shown with that distance only, and can be dismissed", () =>
  on({ prepare: failHierarchy }, async ({ page, until, screenshot }) => {
    const banner = page.locator("#banner");
    await page.locator('#result[data-state="done"]').waitFor();
    assert.ok(await banner.isHidden());
    await until("done", () => page.selectOption("#method", "hierarchy"));
    assert.match(await banner.textContent(), /GPU could not be used.*failed on purpose/s);
    await screenshot("notice");
    await until("done", () => page.selectOption("#method", "certified"));
    assert.ok(await banner.isHidden(), "the next distance has no notice");
    await until("done", () => page.selectOption("#method", "hierarchy"));
    await page.locator("#dismiss").click();
    assert.ok(await banner.isHidden(), "dismissed");
    await until("done", () => page.locator("#move-x-exact").fill("0.1"));
    assert.ok(await banner.isHidden(), "the same notice stays dismissed");
  }));
