// The page of a deforming surface: frames of a moving sheet, measured as the package does.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Hausdorff } from "nurbs-hausdorff";
import { open } from "../support/open.mjs";

let opened;

before(async () => {
  opened = await open({ webgpu: false, path: "deforming.html" });
});

after(() => opened.close());

const data = () => opened.page.locator("#run").evaluate(({ dataset }) => ({ ...dataset }));

/** Waits for more frames of the current run. */
const frames = (count) =>
  opened.page.waitForFunction(
    (count) => {
      const { state, frames } = document.getElementById("run").dataset;
      return state === "running" && Number(frames) >= count;
    },
    count,
    { polling: 50 },
  );

async function pause() {
  await opened.page.locator("#pause").click();
  // The last frame may still be measured.
  await opened.page.waitForTimeout(1000);
}

/** The interval of the sheet that the page describes, by the package on this machine. */
async function measured(counts, angle, options) {
  const knots = (count) =>
    Array.from({ length: count + 4 }, (_, index) => Math.min(Math.max(index - 3, 0), count - 3));
  const controlPoints = Array.from({ length: counts[0] * counts[1] }, (_, index) => {
    const x = (3 * Math.floor(index / counts[1])) / (counts[0] - 1) - 1.5;
    const y = (3 * (index % counts[1])) / (counts[1] - 1) - 1.5;
    return [x, y, 0.3 * Math.sin(2 * x + 1.5 * y + angle), 1];
  }).flat();
  const [knotsU, knotsV] = counts.map(knots);
  const hd = await Hausdorff.create({ backend: "cpu" });
  const sheet = hd.model([{ degree: [3, 3], counts, knotsU, knotsV, controlPoints }]);
  try {
    return await hd.distance(sheet, hd.shape("torus"), options);
  } finally {
    hd.dispose();
  }
}

test("every frame's interval contains the distance of its sheet", async () => {
  await frames(20);
  await pause();
  const { angle, lower, upper } = await data();
  assert.ok(Number(angle) > 0);
  // Two intervals that both contain the distance overlap.
  const expected = await measured([14, 13], Number(angle), { relativeTolerance: 1e-6 });
  assert.ok(Number(lower) <= expected.upper && expected.lower <= Number(upper));
  assert.ok(Number(upper) - Number(lower) <= 1e-4 * expected.diagonal);
  await opened.screenshot("deforming");
});

test("the charts and the rate are live", async () => {
  const { page } = opened;
  assert.match(await page.locator("#rate").textContent(), /^\d+\.\d$/);
  for (const chart of ["distance", "time"]) {
    const colours = await page.locator(`#chart-${chart} canvas`).evaluate((canvas) => {
      const { width, height } = canvas;
      const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
      return new Set(new Uint32Array(data.buffer)).size;
    });
    assert.ok(colours > 8, `${colours} colours in ${chart}`);
  }
  const { angle } = await data();
  await page.locator("#pause").click();
  await frames(3);
  assert.ok(Number((await data()).angle) >= Number(angle));
});

test("sheet, part and method can be changed while frames are measured", async () => {
  const { page } = opened;
  await page.selectOption("#size", "100 100");
  await page.selectOption("#part", "sphere");
  await page.selectOption("#method", "hierarchy");
  await page.selectOption("#tolerance", "0.01");
  await frames(2);
  const { lower, upper } = await data();
  assert.ok(0 < Number(lower) && Number(lower) <= Number(upper));
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
