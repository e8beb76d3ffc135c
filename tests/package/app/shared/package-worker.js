// A program that measures in the package's worker, and many points in two.
import { Hausdorff } from "nurbs-hausdorff/worker";

/** So many that the second worker begins while they are measured. */
const COUNT = 60_000;

export async function measure(worker) {
  const hd = await Hausdorff.create({ backend: "cpu", workers: 2, ...(worker && { worker }) });
  const [a, b] = await Promise.all(["sphere", "sphere-larger"].map((name) => hd.shape(name)));
  const { lower, upper } = await hd.distance(a, b);
  const error = await errorOfPoints(hd);
  hd.dispose();
  return { lower, upper, ...(error && { error }) };
}

/** What is wrong of the distances of points all over the box of a torus. */
async function errorOfPoints(hd) {
  const model = await hd.shape("torus");
  const [outer, , tube] = model.boundingBox.max;
  const points = Float64Array.from(
    { length: 3 * COUNT },
    (_, at) => outer * Math.sin(at * Math.sqrt(at % 3 === 2 ? 3 : 2)),
  );
  const { distances } = await hd.closestPoints(model, points);
  if (hd.workers !== 2) return `${hd.workers} workers`;
  const isWrong = (distance, at) => {
    const [x, y, z] = points.subarray(3 * at, 3 * at + 3);
    const truth = Math.abs(Math.hypot(Math.hypot(x, y) - (outer - tube), z) - tube);
    return !(Math.abs(distance - truth) < 1e-8);
  };
  const wrong = distances.findIndex(isWrong);
  return wrong === -1 ? undefined : `distance ${wrong} is ${distances[wrong]}`;
}

export const report = (error) => ({ error: `${error.code}: ${error.message}` });
