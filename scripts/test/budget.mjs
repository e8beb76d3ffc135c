// Checks the sizes of the wasm modules, plain and gzipped, against their budgets.
import { gzipSync } from "node:zlib";
import { moduleIn, modules } from "../build/wasm/modules.mjs";
import { small } from "../build/wasm/small.mjs";
import { Failure, say } from "../process.mjs";

/**
 * The largest sizes, in KiB, with about 2 % of room. The core has all that is measured. Without best fits, statistics,
 * scores, volumes in common, checks of bodies and maps it would have 802 KiB gzipped; fetched later, they would need the
 * rest of the core once more beside them, and each model prepared twice: who measures one of them would fetch
 * 1,850 KiB (benches/RESULTS.md). The readers of CAD files are fetched when a first one comes, those of meshes, with
 * archives and XML, when a mesh comes, and those of scans when a scan comes.
 */
const budgets = {
  nurbs_hausdorff: { plain: 2745, gzipped: 1172 },
  nurbs_hausdorff_readers: { plain: 973, gzipped: 420 },
  nurbs_hausdorff_meshes: { plain: 720, gzipped: 316 },
  nurbs_hausdorff_scans: { plain: 387, gzipped: 156 },
};

/** Compares one module with its budget. */
function check(module) {
  const budget = budgets[module.name];
  const bytes = moduleIn(small, module);
  const size = { plain: bytes.length / 1024, gzipped: gzipSync(bytes, { level: 9 }).length / 1024 };
  const parts = Object.keys(budget).map(
    (kind) => `${kind} ${size[kind].toFixed(1)} of ${budget[kind]} KiB`,
  );
  say(`${module.name}: ${parts.join(", ")}`);
  return Object.keys(budget).every((kind) => size[kind] <= budget[kind]);
}

export function checkBudget() {
  const over = modules.filter((module) => !check(module)).map(({ name }) => name);
  if (over.length > 0) throw new Failure(`over budget: ${over.join(", ")}`);
}
