// A program that measures in the package's worker.
import { Hausdorff } from "nurbs-hausdorff/worker";

export async function measure(worker) {
  const hd = await Hausdorff.create({ backend: "cpu", ...(worker && { worker }) });
  const [a, b] = await Promise.all(["sphere", "sphere-larger"].map((name) => hd.shape(name)));
  const { lower, upper } = await hd.distance(a, b);
  hd.dispose();
  return { lower, upper };
}

export const report = (error) => ({ error: `${error.code}: ${error.message}` });
