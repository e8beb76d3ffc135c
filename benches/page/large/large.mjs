// node benches/page/large/large.mjs [A B]: opens two large files at once on the built page (`npx vite build
// www`) in headless Chromium, or without any two meshes of a million triangles each. Prints the seconds until
// the first faces are drawn, both models, the interval and all colours; the resident memory of the page's
// processes; the longest task of the main thread, in milliseconds of its own CPU; and the milliseconds that a
// click on the models takes until its point is found, at once and after the trees of triangles are built.
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, extname, join } from "node:path";
import { open } from "../../../tests/page/support/open.mjs";
import { watch } from "../marks.mjs";
import { resident } from "../resident.mjs";
import { mainThreadTasks, trace } from "../tracing.mjs";
import { writeScan } from "./scan.mjs";

/** Cells along a side of the sheet: 999,698 triangles. */
const CELLS = 707;
/** What B lies above A, in mm. */
const LIFT = 0.25;
/** Milliseconds after which the colours are given up. */
const TIMEOUT = 600_000;
/** Milliseconds in which the trees are built. */
const TREES = 10_000;
const PICKS = 5;

const folder = await mkdtemp(join(tmpdir(), "large-"));
const files = process.argv.slice(2);
if (files.length === 0) {
  files.push(join(folder, "scan-a.stl"), join(folder, "scan-b.stl"));
  for (const [index, file] of files.entries()) writeScan(file, CELLS, index * LIFT);
}

/** The milliseconds of clicks on the view, each done when its event is; `middle` is that of the models in it. */
function clicks([count, middle]) {
  const canvas = document.getElementById("canvas");
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return Array.from({ length: count }, (_, index) => {
    const at = {
      clientX: left + (0.48 + 0.01 * index) * width,
      clientY: top + (middle + 0.01 * index) * height,
      ...{ isPrimary: true, bubbles: true, button: 0 },
    };
    canvas.dispatchEvent(new PointerEvent("pointerdown", at));
    const before = performance.now();
    canvas.dispatchEvent(new PointerEvent("pointerup", at));
    return performance.now() - before;
  });
}

const opened = await open({ path: "" });
try {
  const { page } = opened;
  await page.locator('#result[data-state="done"]').waitFor();
  const end = await trace(page);
  const [, b] = files;
  await page.evaluate(watch, basename(b, extname(b)));
  await page.setInputFiles("#file-both", files);
  await page.waitForFunction(() => window.marks.drawn, undefined, { timeout: TIMEOUT });
  const picked = async (middle) =>
    (await page.evaluate(clicks, [PICKS, middle])).map((time) => time.toFixed(1)).join(", ");
  console.log(`clicks once both models are drawn: ${await picked(0.5)} ms`);
  await page.waitForFunction(() => window.marks.colours, undefined, { timeout: TIMEOUT });
  for (const [what, time] of Object.entries(await page.evaluate(() => window.marks))) {
    console.log(`${what}: ${(time / 1000).toFixed(2)} s`);
  }
  console.log(`resident: ${resident().toFixed(0)} MiB`);
  await page.waitForTimeout(TREES);
  const trees = await page.evaluate(() =>
    performance.getEntriesByName("tree of triangles").map(({ duration }) => duration),
  );
  const took = trees.map((duration) => `${(duration / 1000).toFixed(2)} s`);
  console.log(`trees built in: ${took.join(", ")}`);
  console.log(`clicks later: ${await picked(0.25)} ms`);
  // With the legend, models are drawn above the middle.
  console.log(`points found: ${await page.locator(".pin").count()} of ${2 * PICKS}`);
  const tasks = mainThreadTasks(await end());
  console.log(`longest tasks: ${tasks.slice(0, 5).map((time) => time.toFixed(0)).join(", ")} ms of CPU`);
  await opened.screenshot("large");
} finally {
  await opened.close();
  await rm(folder, { recursive: true });
}
