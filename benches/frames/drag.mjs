// node benches/frames/drag.mjs [A.stp.gz B.stp.gz]: answers a second to where a dragged part stands,
// by the built package's worker in Node: `clearance` at a new transform each time, as a page asks
// while the part is moved by hand. NIST 5 in NIST 1 of ../shared/models unless files are given.
// Prints answers a second by the clock and of CPU time, and the slowest answer, for intervals at
// 1e-3 and 1e-6 of the diagonal and for decisions at a limit, and how soon a cancelled call ends.
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import { Hausdorff } from "nurbs-hausdorff/worker";

const ANSWERS = 300;
const WARM_UP = 10;
const shared = new URL("../../../shared/models/step/", import.meta.url);
const given = process.argv.slice(2);
const files = given.length === 2 ? given : ["NIST_MBE_PMI_5", "NIST_MBE_PMI_1"];

const bytes = (file) =>
  gunzipSync(readFileSync(given.length === 2 ? file : new URL(`${file}.stp.gz`, shared)));
const hd = await Hausdorff.create({ backend: "cpu" });
const [a, b] = await Promise.all(files.map((file) => hd.readCad(bytes(file))));
const center = (model) => model.boundingBox.min.map((low, axis) => (low + model.boundingBox.max[axis]) / 2);
const size = Math.hypot(...b.boundingBox.max.map((high, axis) => high - b.boundingBox.min[axis]));
const [from, to] = [center(a), center(b)];

/** Returns the pose of a step: A's centre circles about B's, through its middle and its faces. */
function pose(step) {
  const turn = (2 * Math.PI * step) / ANSWERS;
  const out = [Math.cos(3 * turn), Math.sin(2 * turn), Math.sin(5 * turn)];
  const [sin, cos] = [Math.sin(turn), Math.cos(turn)];
  const translation = out.map((part, axis) => {
    const turned = [cos * from[0] - sin * from[1], sin * from[0] + cos * from[1], from[2]];
    return to[axis] - turned[axis] + 0.5 * size * part;
  });
  return { translation, rotation: [0, 0, Math.sin(turn / 2), Math.cos(turn / 2)] };
}

const kinds = [
  ["interval at 1e-3", { relativeTolerance: 1e-3 }],
  ["interval at 1e-6", {}],
  ["limit", { limit: 0.01 * size }],
];
for (const [name, options] of kinds) {
  const times = [];
  const overlaps = {};
  let cpu;
  for (let step = -WARM_UP; step < ANSWERS; step++) {
    if (step === 0) cpu = process.cpuUsage();
    const started = performance.now();
    const { overlap } = await hd.clearance(a, b, { ...options, transform: pose(step) });
    if (step < 0) continue;
    times.push(performance.now() - started);
    const kind = overlap?.kind ?? "unknown";
    overlaps[kind] = (overlaps[kind] ?? 0) + 1;
  }
  const { user, system } = process.cpuUsage(cpu);
  const seconds = times.reduce((sum, time) => sum + time, 0) / 1e3;
  const rate = (count) => (ANSWERS / count).toFixed(0);
  console.log(
    `${name}: ${rate(seconds)} answers a second by the clock, ${rate((user + system) / 1e6)} of CPU time,`,
    `slowest ${Math.max(...times).toFixed(1)} ms, ${JSON.stringify(overlaps)}`,
  );
}

const controller = new AbortController();
const call = hd.clearance(a, b, { tolerance: 1e-300, transform: pose(1), signal: controller.signal });
const started = performance.now();
controller.abort();
await call.catch(({ code }) => console.log(`${code} after ${(performance.now() - started).toFixed(1)} ms`));
hd.dispose();
