// How much a function of a wasm module runs before V8 compiles it once more, optimised.
import { setFlagsFromString } from "node:v8";

/**
 * In V8's unit, roughly bytes executed. By default, 1.8 million in Node 20, V8 optimises hundreds of
 * functions in a run of a tenth of a second, which takes a second of CPU time: two thirds of such a
 * process. With this budget only functions of long runs are optimised, some 50 ms of running later.
 */
const TIERING_BUDGET = 100_000_000;

/** Sets the budget of the modules loaded from here on; other engines than V8 keep their own. */
export function delayTiering(): void {
  const { bun, deno } = process.versions;
  if (bun === undefined && deno === undefined) {
    setFlagsFromString(`--wasm-tiering-budget=${TIERING_BUDGET}`);
  }
}
