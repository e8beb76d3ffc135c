// The program starts the package's worker, from a bundle of its own.
import { measure, report } from "./shared/package-worker.js";

const worker = new Worker(new URL("./thread.js", import.meta.url), { type: "module" });
globalThis.outcome = measure(worker).catch(report);
