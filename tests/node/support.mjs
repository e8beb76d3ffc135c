// What the tests of the package share: the package as users import it, on the
// tests' WebGPU, and models to check against.
import assert from "node:assert/strict";
import { Hausdorff, HausdorffError } from "nurbs-hausdorff";
import { installWebGpu } from "../../scripts/test/dawn.mjs";

installWebGpu();

export const create = (options) => Hausdorff.create(options);

/** A bilinear square of side 1 in the plane of this z, as plain arrays. */
export function square(z = 0) {
  return {
    degree: [1, 1],
    knotsU: [0, 0, 1, 1],
    knotsV: new Float64Array([0, 0, 1, 1]),
    counts: [2, 2],
    controlPoints: new Float64Array([0, 0, z, 1, 0, 1, z, 1, 1, 0, z, 1, 1, 1, z, 1]),
  };
}

/** The same square as interchange JSON. */
export function interchangeSquare(z = 0) {
  return {
    name: "square",
    surfaces: [
      {
        degree: [1, 1],
        knots_u: [0, 0, 1, 1],
        knots_v: [0, 0, 1, 1],
        ctrl: [
          [
            [0, 0, z, 1],
            [0, 1, z, 1],
          ],
          [
            [1, 0, z, 1],
            [1, 1, z, 1],
          ],
        ],
      },
    ],
  };
}

/** An engine of a worker's class `Hausdorff` and one of the main entry, both on the CPU. */
export const createBoth = (Away) =>
  Promise.all([Away, Hausdorff].map((type) => type.create({ backend: "cpu" })));

/** A check for `assert.throws` and `assert.rejects`. */
export const withCode = (code, message) => (error) => {
  assert.ok(error instanceof HausdorffError, `${error?.stack ?? error}`);
  assert.equal(error.code, code, error.message);
  if (message !== undefined) assert.match(error.message, message);
  return true;
};

/** Fails unless the two numbers differ by at most `tolerance`. */
export function near(actual, expected, tolerance) {
  assert.ok(
    Math.abs(actual - expected) <= tolerance,
    `${actual} is not ${expected} ± ${tolerance}`,
  );
}

/** The largest share of the time of some work for which it may block its caller's thread at once. */
const MAX_SHARE = 1 / 4;
/** Other programs may take the processor away: the least share of some attempts counts. */
const ATTEMPTS = 10;

/** The longest time without a turn of the caller's thread while `work` was done, as a share of the work's time. */
async function longestBlock(work) {
  const start = performance.now();
  let longest = 0;
  let last = start;
  const tick = () => {
    const now = performance.now();
    longest = Math.max(longest, now - last);
    last = now;
  };
  const timer = setInterval(tick, 1);
  await work();
  tick();
  clearInterval(timer);
  return longest / (last - start);
}

/** Fails if `work`, which takes long enough for many turns, blocks the caller's thread for a large share of its time. */
export async function givesWay(work) {
  let least = Number.POSITIVE_INFINITY;
  for (let attempt = 0; attempt < ATTEMPTS && least > MAX_SHARE; attempt++) {
    least = Math.min(least, await longestBlock(work));
  }
  assert.ok(least <= MAX_SHARE, `blocked for ${least} of the time`);
}
