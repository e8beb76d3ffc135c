// node benches/frames/frames.mjs: frames a second of a deforming sheet against a fixed
// part, each frame an update of its control points and one directed distance,
// by the built package in Node on one thread; benches/frames/main.rs measures the same
// natively. With --chromium in headless Chromium, as a page does.
import { existsSync } from "node:fs";
import { parseArgs } from "node:util";

/** Sizes of the sheet's net, and the frames measured after the first ones. */
export const sizes = [
  { counts: [14, 13], frames: 120 },
  { counts: [100, 100], frames: 12 },
];

export const methods = [
  { method: "certified", relativeTolerance: 1e-4 },
  { method: "hierarchy", relativeTolerance: 1e-4, grid: 64 },
];

const { values } = parseArgs({ options: { chromium: { type: "boolean", default: false } } });

/** Measures all sizes by all methods; self-contained, as it is also sent to a browser. */
async function measure(entry, sizes, methods) {
  const { Hausdorff } = await import(entry);
  const DEGREE = 3;
  const WARM_UP = 3;
  const knots = (count) =>
    Array.from({ length: count + DEGREE + 1 }, (_, index) =>
      Math.min(Math.max(index - DEGREE, 0), count - DEGREE),
    );
  // The sheet lies across the unit torus, and a wave runs through it.
  const points = ([rows, columns], time) => {
    const net = new Float64Array(4 * rows * columns);
    for (let index = 0; index < rows * columns; index++) {
      const x = 3 * (Math.floor(index / columns) / (rows - 1)) - 1.5;
      const y = 3 * ((index % columns) / (columns - 1)) - 1.5;
      net.set([x, y, 0.3 * Math.sin(2 * x + 1.5 * y + time), 1], 4 * index);
    }
    return net;
  };
  const hd = await Hausdorff.create({ backend: "cpu" });
  const fixed = hd.shape("torus");
  const rows = [];
  for (const { counts, frames } of sizes) {
    for (const options of methods) {
      const [knotsU, knotsV] = counts.map(knots);
      const controlPoints = points(counts, 0);
      const sheet = hd.model([{ degree: [DEGREE, DEGREE], counts, knotsU, knotsV, controlPoints }]);
      const times = [];
      let updates = 0;
      let cpu = globalThis.process?.cpuUsage();
      for (let frame = 0; frame < frames + WARM_UP; frame++) {
        const net = points(counts, 0.1 * frame);
        const started = performance.now();
        sheet.update(0, net);
        const updated = performance.now();
        await hd.distance(sheet, fixed, options);
        if (frame < WARM_UP) {
          cpu = globalThis.process?.cpuUsage();
          continue;
        }
        times.push(performance.now() - started);
        updates += updated - started;
      }
      // Of all threads, the compiler's too; unlike the times, other programs add little to it.
      const used = globalThis.process?.cpuUsage(cpu);
      const busy = used ? (used.user + used.system) / 1000 / frames : Number.NaN;
      times.sort((a, b) => a - b);
      const mean = times.reduce((sum, time) => sum + time, 0) / frames;
      const rate = 1000 / mean;
      const name = `${counts.join(" x ")}, ${options.method}`;
      rows.push({ name, rate, median: times[frames >> 1], fastest: times[0], update: updates / frames, busy });
      sheet.dispose();
    }
  }
  return rows;
}

async function inChromium() {
  const { chromium } = await import("playwright-core");
  const { serve } = await import("../../tests/package/serve.mjs");
  const { inRoot } = await import("../../scripts/paths.mjs");
  const { launchOptions } = await import("../../scripts/test/browser.mjs");
  const server = await serve(inRoot());
  const browser = await chromium.launch(launchOptions);
  try {
    const page = await browser.newPage();
    await page.goto(`${server.address}/LICENSE-MIT`);
    const text = `(${measure})("/dist/index.js", ${JSON.stringify(sizes)}, ${JSON.stringify(methods)})`;
    return await page.evaluate(text);
  } finally {
    await browser.close();
    server.close();
  }
}

if (!existsSync(new URL("../../dist/index.js", import.meta.url))) {
  console.error("frames: npm run build first");
  process.exit(2);
}
const rows = values.chromium ? await inChromium() : await measure("nurbs-hausdorff", sizes, methods);
console.log("net, method                frames/s   median ms  fastest ms  of which update ms   CPU ms");
for (const { name, rate, median, fastest, update, busy } of rows) {
  const column = (x) => (Number.isNaN(x) ? "-" : x.toFixed(2)).padStart(11);
  const columns = [rate, median, fastest, update, busy].map(column).join(" ");
  console.log(`${name.padEnd(24)} ${columns}`);
}
