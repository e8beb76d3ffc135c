// What several workers of the package take beside one, in Node, as a whole process:
//   node benches/points/pool.mjs points|maps WORKERS [--count N] [--file FILE]
// points: 100,000 points, or another number, near the model, within 1 % of its diagonal of its triangles, with signs, to 1e-6 of it;
// maps: the maps of both of the model and its copy, moved by 0.1.
// Prints the seconds of each step by the clock, the seconds of CPU of the busiest threads so far, where Linux tells
// them, and a digest of the result, which does not depend on the number of workers.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { Hausdorff } from "nurbs-hausdorff/worker";
import { inRoot } from "../../scripts/paths.mjs";

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    count: { type: "string", default: "100000" },
    file: { type: "string", default: "step/NIST_MBE_PMI_2.stp.gz" },
  },
});
const [what = "points", workers = "1"] = positionals;
const { file } = values;
const COUNT = Number(values.count);

/** Where Linux tells the time of each thread of this process, in ticks of 10 ms. */
const TASKS = "/proc/self/task";

function busiestThreads() {
  if (!existsSync(TASKS)) return "";
  const ticks = readdirSync(TASKS).map((task) => {
    const [, fields] = readFileSync(`${TASKS}/${task}/stat`, "utf8").split(") ");
    return Number(fields.split(" ")[11]);
  });
  const busiest = ticks.sort((one, other) => other - one).slice(0, Math.max(1, Number(workers) || 0));
  return `(CPU ${busiest.map((time) => (time / 100).toFixed(2)).join(", ")})`;
}

const started = performance.now();
let last = started;
function lap(step) {
  const now = performance.now();
  console.log(`${step} ${((now - last) / 1000).toFixed(2)} ${busiestThreads()}`);
  last = now;
}

/** The same numbers from 0 to 1 in every run. */
function* numbers(seed = 1) {
  for (let state = seed; ; ) {
    state = (state * 48_271) % 2_147_483_647;
    yield state / 2_147_483_647;
  }
}

async function pointsNear(model) {
  const { positions, origin } = await model.tessellate();
  const { min, max } = model.boundingBox;
  const reach = 0.01 * Math.hypot(...min.map((value, axis) => max[axis] - value));
  const random = numbers();
  const next = () => random.next().value;
  const points = new Float64Array(3 * COUNT);
  for (let at = 0; at < points.length; at += 3) {
    const vertex = 3 * Math.floor((next() * positions.length) / 3);
    for (let axis = 0; axis < 3; axis++) {
      const off = (reach * (2 * next() - 1)) / Math.sqrt(3);
      points[at + axis] = positions[vertex + axis] + origin[axis] + off;
    }
  }
  return points;
}

function digest(arrays) {
  const hash = createHash("sha256");
  for (const { buffer, byteOffset, byteLength } of arrays) {
    hash.update(new Uint8Array(buffer, byteOffset, byteLength));
  }
  return hash.digest("hex").slice(0, 16);
}

const arraysOf = (found) => Object.values(found).filter(ArrayBuffer.isView);

const hd = await Hausdorff.create({
  backend: "cpu",
  workers: workers === "auto" ? workers : Number(workers),
});
const bytes = readFileSync(inRoot("..", "shared", "models", file));
const a = await hd.readCad(bytes, { name: file });
lap("read");
if (what === "points") {
  const points = await pointsNear(a);
  lap("points");
  const found = await hd.closestPoints(a, points, { relativeTolerance: 1e-6 });
  lap("closest");
  console.log(digest(arraysOf(found)), found.signs, hd.workers);
} else {
  const b = await hd.readCad(bytes, { name: file });
  lap("read");
  const options = { a: {}, b: {}, transform: { translation: [0.1, 0, 0] } };
  const maps = await hd.deviationMaps(a, b, { ...options, onCoarse: () => lap("coarse") });
  lap("fine");
  const counts = [maps.a, maps.b].map(({ distances }) => distances.length);
  console.log(digest([maps.a, maps.b].flatMap(arraysOf)), maps.a.signs, hd.workers, ...counts);
}
hd.dispose();
