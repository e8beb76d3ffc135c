// node benches/points/points.mjs: the closest points of occt_linkrods to a million points
// near it, as a scan has them, by the built package in Node on one thread, natively
// (benches/points/main.rs), and by three-mesh-bvh, Open3D and OpenCASCADE, where they are
// installed: the first with npm, the others in the environment of benches/peers, or
// of the Python that PYTHON names. The meshes are this package's tessellation.
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { Hausdorff } from "nurbs-hausdorff";
import { BufferAttribute, BufferGeometry, Vector3 } from "three";
import { MeshBVH } from "three-mesh-bvh";
import { inRoot } from "../../scripts/paths.mjs";
import { ask } from "../../scripts/process.mjs";

const { values } = parseArgs({
  options: {
    count: { type: "string", default: "1000000" },
    model: { type: "string", default: "occt_linkrods" },
    // The points' largest distance from the tessellation, relative to the diagonal.
    noise: { type: "string", default: "0.01" },
  },
});
const count = Number(values.count);
const folder = inRoot("target", "points");
const modelFile = inRoot("..", "shared", "models", `${values.model}.json`);
if (!existsSync(modelFile)) {
  console.error(`points: there is no ${modelFile}`);
  process.exit(2);
}
mkdirSync(folder, { recursive: true });

/** A generator of numbers in [0, 1): xorshift of 32 bits. */
function random(seed) {
  let state = seed;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
}

/** Points on the triangles, spread by area, each moved by up to `reach` along every axis. */
function scan(positions, indices, origin, reach) {
  const next = random(1);
  const corner = (index) => [0, 1, 2].map((axis) => positions[3 * index + axis] + origin[axis]);
  const triangles = Array.from({ length: indices.length / 3 }, (_, t) =>
    [0, 1, 2].map((side) => corner(indices[3 * t + side])),
  );
  const area = ([a, b, c]) => {
    const [u, v] = [b, c].map((p) => p.map((x, axis) => x - a[axis]));
    return Math.hypot(
      u[1] * v[2] - u[2] * v[1],
      u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0],
    );
  };
  const areas = triangles.map(area);
  const total = areas.reduce((sum, x) => sum + x, 0);
  const points = new Float64Array(3 * count);
  let [triangle, reached] = [0, areas[0]];
  for (let index = 0; index < count; index++) {
    while (reached < (total * index) / count) reached += areas[++triangle];
    const [a, b, c] = triangles[triangle];
    let [s, t] = [next(), next()];
    if (s + t > 1) [s, t] = [1 - s, 1 - t];
    for (let axis = 0; axis < 3; axis++) {
      const on = a[axis] + s * (b[axis] - a[axis]) + t * (c[axis] - a[axis]);
      points[3 * index + axis] = on + reach * (2 * next() - 1);
    }
  }
  return points;
}

/** Prints a tool's rates: by the clock, and by the processor's time of all its threads. */
const report = (name, [seconds, busy], points, note) => {
  const [rate, perCore] = [seconds, busy].map((time) => Math.round(points / time).toLocaleString("en"));
  console.log(`${name.padEnd(34)} ${rate} points/s, ${perCore} per second of one core, ${note}`);
};

const timed = async (work) => {
  const [started, used] = [performance.now(), process.cpuUsage()];
  const result = await work();
  const { user, system } = process.cpuUsage(used);
  return [[(performance.now() - started) / 1000, (user + system) / 1e6], result];
};

const hd = await Hausdorff.create({ backend: "cpu" });
const model = hd.model(readFileSync(modelFile, "utf8"));
const { min, max } = model.boundingBox;
const diagonal = Math.hypot(...max.map((x, axis) => x - min[axis]));
const { positions, indices, origin } = model.tessellate();
const points = scan(positions, indices, origin, Number(values.noise) * diagonal);
console.log(`${values.model}: ${indices.length / 3} triangles, ${count} points, diagonal ${diagonal}`);
writeFileSync(`${folder}/points.f64`, points);
writeFileSync(`${folder}/positions.f32`, positions);
writeFileSync(`${folder}/indices.u32`, indices);
writeFileSync(`${folder}/origin.json`, JSON.stringify(origin));

// The first points pay for the patches' cuts and trees.
await hd.closestPoints(model, points.subarray(0, 3));
const [times, exact] = await timed(() => hd.closestPoints(model, points));
const widest = exact.bounds.reduce((most, bound) => Math.max(most, bound), 0);
report("this package in Node", times, count, `each within ${widest.toExponential(1)}`);

/**
 * How far the distances that others found, of all points or of every so many, are from
 * the certified ones, relative to the diagonal.
 */
function deviation(distances) {
  let most = 0;
  const stride = Math.floor(count / distances.length);
  for (let index = 0; index < distances.length; index++) {
    const [distance, bound] = [exact.distances[index * stride], exact.bounds[index * stride]];
    const beyond = Math.abs(distances[index] - distance) - bound;
    most = Math.max(most, beyond);
  }
  return `off by up to ${(most / diagonal).toExponential(1)} of the diagonal`;
}

const native = ask("cargo", ["bench", "--bench", "points", "--", modelFile, `${folder}/points.f64`]);
if (native !== undefined) {
  const { seconds, busy, bound } = JSON.parse(native);
  report("natively", [seconds, busy], count, `each within ${bound.toExponential(1)}`);
}

{
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  const bvh = new MeshBVH(geometry);
  const [point, target] = [new Vector3(), {}];
  const distances = new Float64Array(count);
  const [times] = await timed(() => {
    for (let index = 0; index < count; index++) {
      point.fromArray(points, 3 * index);
      point.set(point.x - origin[0], point.y - origin[1], point.z - origin[2]);
      distances[index] = bvh.closestPointToPoint(point, target).distance;
    }
  });
  report("three-mesh-bvh, on the mesh", times, count, deviation(distances));
}

const python = process.env.PYTHON ?? inRoot("benches", "peers", ".venv", "bin", "python");
const script = inRoot("benches", "points", "points.py");
const run = spawnSync(python, [script, folder, modelFile], { encoding: "utf8", maxBuffer: 1 << 28 });
if (run.status !== 0) console.log(`Open3D, OpenCASCADE: not measured: ${run.stderr ?? run.error}`);
for (const line of (run.stdout ?? "").trim().split("\n").filter(Boolean)) {
  const { name, seconds, busy, distances } = JSON.parse(line);
  const found = readFileSync(distances);
  const list = new Float64Array(found.buffer, found.byteOffset, found.length / 8);
  report(name, [seconds, busy], list.length, deviation(list));
}
