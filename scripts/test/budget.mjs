// Checks the sizes of the wasm modules, plain and gzipped, against their budgets.
import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { modules, wasmFile } from "../build/wasm.mjs";
import { inRoot } from "../paths.mjs";
import { Failure, say } from "../process.mjs";

/**
 * The largest sizes, in KiB, with about 5 % of room. The core has what every use needs. Gzipped,
 * cutting trimmed faces takes 60 of it, as interchange JSON has them too; bounding blocks of near
 * copies by splines 4; the proof of every cut, the orders of wires on closed surfaces and the
 * areas of faces 25 together; sides of points, signs, clearances and gaps of solids 48, distances of
 * meshes and points 20; heights of third order, over loops, and projective maps the rest, which takes
 * it above the 700 that it is to have again. The readers are fetched when a CAD file comes: BREP text with what
 * makes faces of edges takes 217, STEP and IGES 66 each. Those of meshes
 * are fetched when a mesh comes: the archives and XML of 3MF, PLY, OBJ and JSON.
 */
const budgets = {
  nurbs_hausdorff: { plain: 1790, gzipped: 728 },
  nurbs_hausdorff_readers: { plain: 890, gzipped: 375 },
  nurbs_hausdorff_meshes: { plain: 550, gzipped: 242 },
};

/** Compares one module with its budget. */
function check(module) {
  const budget = budgets[module.name];
  const bytes = readFileSync(inRoot(wasmFile(module)));
  const size = { plain: bytes.length / 1024, gzipped: gzipSync(bytes, { level: 9 }).length / 1024 };
  const parts = Object.keys(budget).map(
    (kind) => `${kind} ${size[kind].toFixed(1)} of ${budget[kind]} KiB`,
  );
  say(`${wasmFile(module)}: ${parts.join(", ")}`);
  return Object.keys(budget).every((kind) => size[kind] <= budget[kind]);
}

export function checkBudget() {
  const over = modules.filter((module) => !check(module)).map(({ name }) => name);
  if (over.length > 0) throw new Failure(`over budget: ${over.join(", ")}`);
}
