// node benches/page/large/large.mjs [points | assembly | A B]: opens two files at once on the built page (`npx vite
// build www`) in headless Chromium: two meshes of a million triangles each, two scans of a million points each, an
// assembly of 200 parts and its revision in which a part moved, or files. Prints the seconds until the first faces are
// drawn, both models, the interval and all colours; the resident memory of the page's processes; the longest tasks of
// the main thread meanwhile, and while a section is moved, in milliseconds of its own CPU; and the milliseconds that a
// click on the models takes until its point is found, once the trees are built.
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, extname, join } from "node:path";
import { drawn } from "../../../tests/page/support/drawn.mjs";
import { open } from "../../../tests/page/support/open.mjs";
import { watch } from "../marks.mjs";
import { resident } from "../resident.mjs";
import { mainThreadTasks, trace } from "../tracing.mjs";
import { assemblyOf } from "./assembly.mjs";
import { writePoints, writeScan } from "./scan.mjs";

/** Cells along a side of the sheet: 999,698 triangles. */
const CELLS = 707;
/** Points along a side of the sheet. */
const POINTS = 1000;
/** What B lies above A, in mm. */
const LIFT = 0.25;
/** The uses of a part in the assembly, and by how much the last one is moved in B, in mm. */
const PARTS = 200;
const MOVED = 5;
/** Milliseconds after which the colours are given up. */
const TIMEOUT = 600_000;
/** Milliseconds in which the trees are built. */
const TREES = 10_000;
const PICKS = 5;
/** Tasks that are printed. */
const LONGEST = 5;
/** Where sections are, as parts of the models. */
const SECTIONS = [0.3, 0.4, 0.5, 0.6];

const folder = await mkdtemp(join(tmpdir(), "large-"));
const files = await filesOf(process.argv.slice(2));

async function filesOf(args) {
  if (args.length === 2) return args;
  if (args[0] === "assembly") {
    const step = await readFile("examples/parts/a.step", "utf8");
    const made = ["assembly-a.step", "assembly-b.step"].map((name) => join(folder, name));
    for (const [index, file] of made.entries()) {
      await writeFile(file, assemblyOf(step, PARTS, index * MOVED));
    }
    return made;
  }
  const isPoints = args[0] === "points";
  const ending = isPoints ? "xyz" : "stl";
  const made = ["a", "b"].map((name) => join(folder, `scan-${name}.${ending}`));
  for (const [index, file] of made.entries()) {
    if (isPoints) writePoints(file, POINTS, index * LIFT);
    else writeScan(file, CELLS, index * LIFT);
  }
  return made;
}

/** The milliseconds of clicks on the view, each done when its event is. */
function clicks(count) {
  const canvas = document.getElementById("canvas");
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return Array.from({ length: count }, (_, index) => {
    const at = {
      clientX: left + (0.48 + 0.01 * index) * width,
      // With the legend, models are drawn above the middle.
      clientY: top + (0.25 + 0.01 * index) * height,
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
  await page.waitForFunction(() => window.marks.colours, undefined, { timeout: TIMEOUT });
  for (const [what, time] of Object.entries(await page.evaluate(() => window.marks))) {
    console.log(`${what}: ${(time / 1000).toFixed(2)} s`);
  }
  console.log(`resident: ${resident().toFixed(0)} MiB`);
  await page.waitForTimeout(TREES);
  const trees = await page.evaluate(() =>
    performance.getEntriesByName("tree of a model").map(({ duration }) => duration),
  );
  const took = trees.map((duration) => `${(duration / 1000).toFixed(2)} s`);
  console.log(`trees built in: ${took.join(", ")}`);
  const tasks = mainThreadTasks(await end());
  const times = await page.evaluate(clicks, PICKS);
  console.log(`clicks: ${times.map((time) => time.toFixed(1)).join(", ")} ms`);
  console.log(`points found: ${await page.locator(".pin").count()} of ${PICKS}`);
  const longest = (times) => times.slice(0, LONGEST).map((time) => time.toFixed(0)).join(", ");
  console.log(`longest tasks: ${longest(tasks)} ms of CPU`);
  const moved = await trace(page);
  await page.selectOption("#section-axis", "0");
  for (const at of SECTIONS) {
    await page.locator("#section-at").fill(`${at}`);
    await drawn(page);
  }
  console.log(`while a section is moved: ${longest(mainThreadTasks(await moved()))} ms of CPU`);
  await opened.screenshot("large");
} finally {
  await opened.close();
  await rm(folder, { recursive: true });
}
