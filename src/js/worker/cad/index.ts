// `nurbs-hausdorff/worker/cad`: the package's worker, which also reads CAD files.
import { connectBy } from "../hausdorff.js";
import { browser } from "../platform/browser.js";

// Bundlers recognise this expression, and bundle the file that it names.
connectBy(
  browser(() => new Worker(new URL("./thread.js", import.meta.url), { type: "module" })),
  { readers: true },
);

export * from "../exports.js";
export { readCad, type WorkerCadOptions } from "./read.js";
