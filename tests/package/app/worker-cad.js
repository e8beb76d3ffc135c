// A program that reads files and measures in the package's worker.
import { Hausdorff, readCad } from "nurbs-hausdorff/worker/cad";
import { report } from "./package-worker.js";

/** Squares of side 1, 0.2 apart, as files of interchange JSON. */
const file = (z) => {
  const corner = (x, y) => [x, y, z, 1];
  const ctrl = [0, 1].map((x) => [0, 1].map((y) => corner(x, y)));
  const surface = { degree: [1, 1], knots_u: [0, 0, 1, 1], knots_v: [0, 0, 1, 1], ctrl };
  return new TextEncoder().encode(JSON.stringify({ surfaces: [surface] }));
};

async function measure() {
  const hd = await Hausdorff.create({ backend: "cpu" });
  const [a, b] = await Promise.all([0, 0.2].map((z) => readCad(hd, file(z))));
  const { lower, upper } = await hd.distance(a, b);
  hd.dispose();
  return { lower, upper };
}

globalThis.outcome = measure().catch(report);
