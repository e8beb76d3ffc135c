// `nurbs-hausdorff/worker`: the package, all of whose work is done in a worker.
import { connectBy } from "./hausdorff.js";
import { browser } from "./platform/browser.js";

// Bundlers recognise this expression, and bundle the file that it names.
connectBy(browser(() => new Worker(new URL("./thread.js", import.meta.url), { type: "module" })));

export * from "./exports.js";
