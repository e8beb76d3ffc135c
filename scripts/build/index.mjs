// What is built: the wasm modules, then the TypeScript API around them.
import { buildApi } from "./api.mjs";
import { buildColors } from "./wasm/colors.mjs";
import { buildQuick, useSmall } from "./wasm/quick.mjs";
import { buildSmall, small } from "./wasm/small.mjs";

/** Builds what the page and the tests need and what has changed, with a line on each part. */
export async function buildForPage() {
  console.log(
    "build: part 1 of 2: the wasm modules (minutes the first time, none without a change)",
  );
  console.log(`build: wasm modules: ${await buildQuick()}; the page's: ${await buildColors()}`);
  console.log("build: part 2 of 2: the TypeScript API (seconds)");
  console.log(`build: TypeScript API: ${await buildApi()}`);
}

/** Builds the files of the package as they are published. */
export async function buildPackage() {
  console.log(`build: wasm modules, optimised: ${await buildSmall()}`);
  useSmall(small);
  console.log(`build: TypeScript API: ${await buildApi()}`);
}
