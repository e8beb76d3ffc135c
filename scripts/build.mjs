// npm run build: set up, and build the files of the package, optimised.
import { buildPackage } from "./build/index.mjs";
import { Failure } from "./process.mjs";
import { setUpForPage } from "./setup/index.mjs";

try {
  await setUpForPage();
  await buildPackage();
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
