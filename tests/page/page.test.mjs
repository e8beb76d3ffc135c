import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { file, open } from "./open.mjs";

/** A square of side 2 in the plane of this height. */
const plane = (height) => ({
  surfaces: [
    {
      degree: [1, 1],
      knots_u: [0, 0, 1, 1],
      knots_v: [0, 0, 1, 1],
      ctrl: [-1, 1].map((x) => [-1, 1].map((y) => [x, y, height, 1])),
    },
  ],
});

const numbers = (text) => text.split(" ").map(Number);

let opened;

before(async () => {
  opened = await open();
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

test("the first preset is measured, and shown as people shall see it", async () => {
  const { lower, upper, computed, converged } = await opened.data();
  assert.equal(converged, "true");
  assert.ok(Number(lower) <= Number(computed) && Number(computed) <= Number(upper));
  assert.match(await opened.page.locator("#engine").textContent(), /WebGPU/);
  assert.ok(await opened.page.locator("#banner").isHidden());
  await opened.screenshot("page");
});

for (const method of ["certified", "iteration"]) {
  test(`concentric spheres of radius 2 and 2.2 by ${method}`, async () => {
    await opened.until("done", () =>
      opened.page.selectOption("#preset", { label: "Concentric spheres" }),
    );
    await opened.until("done", async () => {
      await opened.page.selectOption("#method", "certified");
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

test("planes dropped as files; the slider moves A, and the arrow follows", async () => {
  await opened.until("done", async () => {
    await opened.page.selectOption("#method", "certified");
    await opened.page.setInputFiles("#file-a", file("low.json", JSON.stringify(plane(0))));
    await opened.page.setInputFiles("#file-b", file("high.json", JSON.stringify(plane(3))));
    await opened.page.locator("#name-b", { hasText: "high.json" }).waitFor();
  });
  await opened.until("done", () => opened.page.locator("#move-z").fill("0"));
  await opened.until("done", () => opened.page.locator("#turn").fill("0"));
  await opened.until("done", () => opened.page.locator("#move-z").fill("0.5"));
  const diagonal = Math.hypot(2, 2);
  const { computed, a, b } = await opened.data();
  assert.ok(Math.abs(Number(computed) - (3 - 0.5 * diagonal)) < 1e-9, computed);
  assert.ok(Math.abs(numbers(a)[2] - 0.5 * diagonal) < 1e-9, a);
  assert.equal(numbers(b)[2], 3);
});

test("dragging a slider recomputes on the way", async () => {
  await opened.until("done", () => opened.page.selectOption("#preset", { label: "Torus, moved" }));
  const box = await opened.page.locator("#move-x").boundingBox();
  const seen = new Set();
  await opened.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await opened.page.mouse.down();
  for (let step = 1; step <= 5; step++) {
    await opened.page.mouse.move(box.x + box.width * (0.5 + 0.05 * step), box.y + box.height / 2);
    await opened.page.waitForTimeout(600);
    seen.add((await opened.data()).computed);
  }
  await opened.page.mouse.up();
  assert.ok(seen.size >= 3, `${seen.size} different distances in 5 steps`);
});

test("projection lines come with statistics", async () => {
  await opened.until("done", () =>
    opened.page.selectOption("#preset", { label: "Two wavy sheets" }),
  );
  await opened.until("done", async () => {
    await opened.page.locator("#samples").fill("32");
    await opened.page.locator("#lines").check();
  });
  await opened.page.locator("dt", { hasText: "rms" }).waitFor();
  await opened.screenshot("lines");
  await opened.until("done", () => opened.page.locator("#lines").uncheck());
});

test("a long certificate is cancelled, with the interval so far", async () => {
  await opened.until("done", () =>
    opened.page.selectOption("#preset", { label: "Concentric spheres" }),
  );
  await opened.until("working", () => opened.page.selectOption("#tolerance", "1e-9"));
  await opened.until("done", () => opened.page.locator("#cancel").click());
  const { converged, lower, upper } = await opened.data();
  assert.equal(converged, "false");
  assert.ok(Number(lower) <= 0.2 + 1e-12 && 0.2 - 1e-12 <= Number(upper), `${lower} ${upper}`);
  await opened.until("done", () => opened.page.selectOption("#tolerance", "1e-6"));
});

test("broken files are named with their code, and the page goes on", async () => {
  const weightless = plane(0);
  weightless.surfaces[0].ctrl[1][0][3] = 0;
  for (const [text, code] of [
    ["not JSON", "JSON_SHAPE"],
    [JSON.stringify(weightless), "WEIGHT_NOT_POSITIVE"],
  ]) {
    await opened.until("failed", () =>
      opened.page.setInputFiles("#file-a", file("broken.json", text)),
    );
    assert.match(await opened.page.locator("#error").textContent(), new RegExp(code));
  }
  await opened.screenshot("error");
  await opened.until("done", () => opened.page.selectOption("#preset", { label: "Torus, moved" }));
  assert.ok(await opened.page.locator("#error").isHidden());
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));

test("without WebGPU it says so and runs on the CPU, on a narrow screen too", async () => {
  const narrow = await open({ webgpu: false, size: { width: 400, height: 800 } });
  try {
    await narrow.page.locator('#result[data-state="done"]').waitFor();
    assert.match(await narrow.page.locator("#banner").textContent(), /No WebGPU/);
    await narrow.until("done", () => narrow.page.selectOption("#method", "iteration"));
    assert.match(await narrow.page.locator("#facts").textContent(), /on the CPU/);
    await narrow.screenshot("narrow-cpu");
  } finally {
    await narrow.close();
  }
});
