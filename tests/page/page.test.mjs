import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn } from "./support/drawn.mjs";
import { modelFile, planes, sphereParts } from "./support/models.mjs";
import { open } from "./support/open.mjs";
import { pixelRows } from "./support/pixels.mjs";

const numbers = (text) => text.split(" ").map(Number);

let opened;

before(async () => {
  // The view is about 910 × 800 pixels beside the panels.
  opened = await open({ size: { width: 1530, height: 848 } });
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** Opens stacks of parallel squares at these heights as models A and B. */
async function openPlanes(a, b) {
  const { page } = opened;
  // Each to its end: that of A's measurement is no sign of B's.
  await opened.until("done", () =>
    page.setInputFiles("#file-a", modelFile("a.json", planes(...a))),
  );
  await opened.until("done", () =>
    page.setInputFiles("#file-b", modelFile("b.json", planes(...b))),
  );
}

/** Returns red, green and blue at the middle of the part of the view above the legend, where a model that is wide is fitted. */
async function colorAboveLegend() {
  const { page } = opened;
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  await drawn(page);
  const at = { x: Math.floor(x + width / 2), y: Math.floor(y + height / 4) };
  const clip = { ...at, width: 1, height: 1 };
  const image = (await page.screenshot({ clip })).toString("base64");
  return page.evaluate(async (image) => {
    const bitmap = await createImageBitmap(
      await (await fetch(`data:image/png;base64,${image}`)).blob(),
    );
    const context = new OffscreenCanvas(1, 1).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    return [...context.getImageData(0, 0, 1, 1).data];
  }, image);
}

test("the first preset is measured and shown", async () => {
  const { page } = opened;
  const { lower, upper, computed, converged } = await opened.data();
  assert.equal(converged, "true");
  assert.ok(Number(lower) <= Number(computed) && Number(computed) <= Number(upper));
  const [from, to] = JSON.parse(await page.locator("#interval").textContent());
  assert.ok(
    from <= Number(lower) && Number(upper) <= to,
    "the interval shown contains the certified one",
  );
  assert.match(await page.locator("#width").textContent(), /contains the distance/);
  assert.match(await page.locator("#engine").textContent(), /WebGPU/);
  assert.ok(await page.locator("#banner").isHidden());
  await opened.screenshot("page");
});

for (const method of ["certified", "iteration"]) {
  test(`concentric spheres of radius 2 and 2.2 by ${method}`, async () => {
    await opened.until("done", () =>
      opened.page.selectOption("#preset", { label: "Concentric spheres" }),
    );
    await opened.until("done", async () => {
      // One that is chosen already is not measured again.
      await opened.page.selectOption("#method", "hierarchy");
      await opened.page.selectOption("#method", method);
    });
    const { lower, upper, a, b, method: used } = await opened.data();
    assert.equal(used, method);
    assert.ok(Number(lower) <= 0.2 + 1e-12 && 0.2 - 1e-12 <= Number(upper), `${lower} ${upper}`);
    assert.ok(Math.abs(Math.hypot(...numbers(a)) - 2) < 1e-9, a);
    assert.ok(Math.abs(Math.hypot(...numbers(b)) - 2.2) < 1e-6, b);
    await opened.screenshot(`spheres-${method}`);
  });
}

test("the deviation of a plane above and below another is signed, coloured, and summarised", async () => {
  const { page } = opened;
  await page.selectOption("#method", "certified");
  await openPlanes([2.9], [3]);
  await page.selectOption("#paint", "a");
  await opened.until("done", () => page.locator("#deviation").check());
  for (const [height, mean, red, ends] of [
    [3.1, "≈ +0.10000", true, ["0.00000", "+0.10000"]],
    [2.9, "≈ −0.10000", false, ["−0.10000", "0.00000"]],
  ]) {
    await opened.until("done", () => page.locator("#move-z-exact").fill(`${height - 2.9}`));
    assert.deepEqual(await opened.texts("#statistics"), {
      "A: mean": "≈ 0.10000",
      "A: signed mean": mean,
      "A: negative": "behind B's normals",
      "A: RMS": "≈ 0.10000",
      "A: median": "≈ 0.10000",
      "A: 95th percentile": "≈ 0.10000",
      "A: 99th percentile": "≈ 0.10000",
      "maximum of the map": "0.10000",
    });
    assert.match(await page.locator("#estimates h3").textContent(), /estimates/);
    // The deviation has one sign, and so has the scale.
    assert.equal(await page.locator("#scale-low").textContent(), ends[0]);
    assert.equal(await page.locator("#scale-high").textContent(), ends[1]);
    const [r, , b] = await colorAboveLegend();
    assert.ok(red ? r > b + 50 : b > r + 50, `red ${r}, blue ${b}`);
  }
  await opened.until("done", () => page.locator("#deviation").uncheck());
  assert.ok(await page.locator("#legend").isHidden());
  assert.ok(await page.locator("#estimates").isHidden());
  await page.selectOption("#paint", "both");
});

/** The rows of the view, from the top, in which the arrow's pixels are, with their number. */
const arrowRows = () =>
  // --accent of the style sheet.
  pixelRows(
    opened.page,
    "[[r, 0xcf], [g, 0x2f], [b, 0x4b]].every(([value, accent]) => Math.abs(value - accent) < 12)",
  );

/** Whether the head, the widest part of the arrow, is in its upper half. */
async function pointsUp() {
  const rows = await arrowRows();
  assert.ok(rows.length > 60, `an arrow of ${rows.length} rows`);
  const widest = rows.reduce((one, other) => (other.count > one.count ? other : one));
  const fraction = (widest.y - rows[0].y) / rows.length;
  assert.ok(Math.abs(fraction - 0.5) > 0.3, `the head is at ${fraction}`);
  return fraction < 0.5;
}

test("the arrow starts at the farthest point of the direction with the larger distance", async () => {
  const { page } = opened;
  // From A, at 0, it is 3 to B; from B, whose upper square is at 5, it is 5 to A.
  await page.selectOption("#method", "certified");
  for (const [file, heights] of [
    ["#file-a", [0]],
    ["#file-b", [3, 5]],
  ]) {
    await opened.until("done", () =>
      page.setInputFiles(file, modelFile("planes.json", planes(...heights))),
    );
  }
  assert.equal((await opened.data()).from, "a");
  assert.equal(await page.locator("#kind").textContent(), "Directed distance, A to B");
  assert.ok(await pointsUp(), "from A up to the square of B at 3");
  await opened.until("done", () => page.locator("#symmetric").check());
  const { from, a, b, computed } = await opened.data();
  assert.deepEqual([from, numbers(a)[2], numbers(b)[2], Number(computed)], ["b", 0, 5, 5]);
  assert.equal(await page.locator("#kind").textContent(), "Symmetric distance, B to A");
  const details = await opened.texts("#facts");
  assert.equal(details["directed, A to B"], "3.00000");
  assert.equal(details["directed, B to A"], "5.00000");
  assert.ok(!(await pointsUp()), "from the square of B at 5 down to A");
  await opened.screenshot("symmetric");
  await opened.until("done", () => page.locator("#symmetric").uncheck());
});

test("projection lines and the painted deviation come with a legend", async () => {
  await opened.until("done", () =>
    opened.page.selectOption("#preset", { label: "Experiments: two wavy sheets" }),
  );
  for (const box of ["#lines", "#deviation"]) {
    await opened.until("done", () => opened.page.locator(box).check());
    assert.ok(await opened.page.locator("#legend").isVisible());
    await opened.screenshot(box.slice(1));
    await opened.until("done", () => opened.page.locator(box).uncheck());
  }
});

test("a long certified search is cancelled, with the interval so far", async () => {
  const { page } = opened;
  for (const [side, part] of Object.entries(sphereParts)) {
    const sphere = modelFile(`${side}.json`, part);
    await opened.until("done", () => page.setInputFiles(`#file-${side}`, sphere));
  }
  await opened.until("working", () => page.selectOption("#tolerance", "1e-9"));
  await page.locator("#cancel").waitFor();
  await opened.screenshot("working");
  await opened.until("cancelled", () => page.locator("#cancel").click());
  const { converged, lower, upper } = await opened.data();
  assert.equal(converged, undefined);
  assert.ok(Number(lower) <= 0.2 + 1e-9 && 0.2 - 1e-9 <= Number(upper), `${lower} ${upper}`);
  assert.match(await page.locator("#width").textContent(), /cancelled; contains the distance/);
  assert.equal(await page.locator("#distance").textContent(), "–");
  await opened.until("done", () => page.selectOption("#tolerance", "1e-6"));
});

test("a cancelled iteration leaves no numbers", async () => {
  const { page } = opened;
  const many = Array.from({ length: 40 }, (_, index) => 0.1 * index);
  await openPlanes(many, many);
  assert.match(await page.locator("#distance").textContent(), /^(0|≤ \d\.\de-\d+)$/);
  await page.locator("#samples").evaluate((samples) => {
    samples.value = "160";
    samples.dispatchEvent(new Event("input", { bubbles: true }));
  });
  await opened.until("working", () => page.selectOption("#method", "iteration"));
  await opened.until("cancelled", () => page.locator("#cancel").click());
  assert.equal(await page.locator("#distance").textContent(), "–");
  assert.equal(await page.locator("#interval").textContent(), "cancelled");
  assert.deepEqual(await opened.texts("#facts"), {});
  assert.ok(await page.locator("#label").isHidden());
  assert.equal((await opened.data()).computed, undefined);
  await opened.screenshot("cancelled");
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
