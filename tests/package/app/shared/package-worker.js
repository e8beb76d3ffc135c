// A program that measures in the package's worker, and many points in two.
import { Hausdorff } from "nurbs-hausdorff/worker";

/** So many that the second worker begins while they are measured. */
const COUNT = 60_000;

export async function measure(worker) {
  const hd = await Hausdorff.create({ backend: "cpu", workers: 2, ...(worker && { worker }) });
  const [a, b] = await Promise.all(["sphere", "sphere-larger"].map((name) => hd.shape(name)));
  const { lower, upper } = await hd.distance(a, b);
  const error = await errorOfPoints(hd, a);
  hd.dispose();
  return { lower, upper, ...(error && { error }) };
}

/** What is wrong of the distances of points on a circle of radius 3 about a sphere of radius 2. */
async function errorOfPoints(hd, sphere) {
  const points = Float64Array.from({ length: 3 * COUNT }, (_, at) => {
    const angle = Math.floor(at / 3);
    return [3 * Math.cos(angle), 3 * Math.sin(angle), 0][at % 3];
  });
  const { distances } = await hd.closestPoints(sphere, points);
  if (hd.workers !== 2) return `${hd.workers} workers`;
  const wrong = distances.find((distance) => !(Math.abs(distance - 1) < 1e-8));
  return wrong === undefined ? undefined : `a distance is ${wrong}`;
}

export const report = (error) => ({ error: `${error.code}: ${error.message}` });
