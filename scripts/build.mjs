// npm run build: set up, and build the files of the package.
import { buildApi } from "./build/api.mjs";
import { buildWasm } from "./build/wasm.mjs";
import { Failure } from "./process.mjs";
import { setUpForPage } from "./setup/index.mjs";

try {
  await setUpForPage();
  console.log(`build: wasm module: ${await buildWasm()}`);
  console.log(`build: TypeScript API: ${await buildApi()}`);
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
