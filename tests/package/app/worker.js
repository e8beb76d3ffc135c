// The package starts its worker, which the bundler finds by its address.
import { measure, report } from "./shared/package-worker.js";

globalThis.outcome = measure().catch(report);
