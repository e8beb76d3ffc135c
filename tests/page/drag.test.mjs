import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drag } from "./support/drag.mjs";
import { modelFile, sharedFile, sphereParts } from "./support/models.mjs";
import { open } from "./support/open.mjs";

let opened;

before(async () => {
  // A small window without WebGPU: without a GPU, drawing and samples compete for the CPU.
  opened = await open({ webgpu: false, size: { width: 800, height: 480 } });
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** The number of results required during a drag; a page that cannot keep up shows none. */
const REQUIRED = 8;

for (const method of ["certified", "iteration"]) {
  test(`a fast drag shows results of ${method} while moving, and nothing jumps`, async (context) => {
    const { page } = opened;
    // Each is waited for: the models before have other digits.
    await opened.until("done", () => page.selectOption("#method", "hierarchy"));
    await opened.until("done", () => page.selectOption("#method", method));
    await page.locator("#samples").evaluate((samples) => {
      samples.value = "16";
      samples.dispatchEvent(new Event("input", { bubbles: true }));
    });
    await opened.until("done", () =>
      page.selectOption("#preset", { label: "Torus and moved copy" }),
    );
    const { results, heights, perSecond } = await drag(page, "#move-x", REQUIRED);
    context.diagnostic(`${perSecond.toFixed(1)} results a second`);
    assert.ok(results.length >= REQUIRED, `${results.length} results while moving`);
    for (const { lower, upper, text } of results) {
      assert.ok(lower <= Number(text) && Number(text) <= upper, `${text} of ${lower} ${upper}`);
    }
    assert.equal(heights.length, 2, heights.join(", "));
    await page.locator('#result[data-state="done"]').waitFor();
  });
}

test("a certified search too long for a drag shows intervals while moving, and finishes at the end", async () => {
  const { page } = opened;
  await opened.until("done", () => page.selectOption("#method", "certified"));
  for (const [side, part] of Object.entries(sphereParts)) {
    const sphere = modelFile(`${side}.json`, part);
    await opened.until("done", () => page.setInputFiles(`#file-${side}`, sphere));
  }
  await opened.until("working", () => page.selectOption("#tolerance", "1e-9"));
  const { results } = await drag(page, "#move-x", REQUIRED);
  await page.selectOption("#tolerance", "1e-4");
  assert.ok(results.length >= REQUIRED, `${results.length} results while moving`);
  for (const { lower, upper } of results) {
    // A moved by d is at the distance 0.2 + d from B.
    assert.ok(lower <= upper && upper >= 0.2, `${lower} ${upper}`);
  }
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.05"));
  const { lower, upper, converged } = await opened.data();
  assert.equal(converged, "true");
  assert.ok(Number(lower) <= 0.25 + 1e-9 && 0.25 - 1e-9 <= Number(upper), `${lower} ${upper}`);
  await page.selectOption("#tolerance", "1e-6");
});

/** The number of results of a drag of a real model, enough to estimate their rate. */
const LIVE = 20;

for (const name of ["duck.json", "utah_teapot_4nurbs.json"]) {
  const model = sharedFile(name);
  const skip = model === undefined && "there is no ../shared/models";
  test(`dragging ${name} keeps its certified interval live`, { skip }, async (context) => {
    const { page } = opened;
    await page.setInputFiles("#file-a", model);
    await page.locator("#shape-a option:checked", { hasText: name }).waitFor({ state: "attached" });
    await page.setInputFiles("#file-b", model);
    await page.locator("#shape-b option:checked", { hasText: name }).waitFor({ state: "attached" });
    await opened.until("done", () => page.locator("#move-x").fill("0.04"));
    const { results, perSecond } = await drag(page, "#move-x", LIVE);
    context.diagnostic(`${perSecond.toFixed(1)} results a second`);
    assert.ok(results.length >= LIVE, `${results.length} results while moving`);
    for (const { lower, upper } of results) assert.ok(lower <= upper, `${lower} ${upper}`);
    await page.locator('#result[data-state="done"]').waitFor();
    await opened.screenshot(name.replace(".json", ""));
  });
}

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
