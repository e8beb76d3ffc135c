// npm test: set up, then run every step of scripts/test/steps.mjs, or only some
// with the steps that they need: npm test -- --only rust,page
// Formats, lints, types and documents, which answer within 90 seconds while one works: npm test -- --quick
// With the modules as they are published, and their budgets: npm test -- --release
import { parseArgs } from "node:util";
import { Failure, heldBack, say } from "./process.mjs";
import { setUpForTests } from "./setup/index.mjs";
import { count } from "./test/count.mjs";
import { steps } from "./test/steps.mjs";

function chosen() {
  const options = {
    only: { type: "string" },
    quick: { type: "boolean", default: false },
    release: { type: "boolean", default: false },
  };
  const { values } = parseArgs({ options });
  if (values.quick) return quickSteps(values.only);
  return chosenOf(values.release ? steps.map(released) : steps, values.only);
}

/** The step as it tests what is published. */
const released = ({ release, ...step }) => ({ ...step, ...release });

/** All steps, or those named in a list with those that they need. */
function chosenOf(steps, only) {
  if (only === undefined) return steps;
  const names = only.split(",");
  const unknown = names.filter((name) => !steps.some((step) => step.name === name));
  if (unknown.length > 0) {
    throw new Failure(
      `unknown step ${unknown.join(", ")}; the steps are: ${steps.map((step) => step.name).join(", ")}`,
    );
  }
  const required = new Set();
  const include = (name) => {
    for (const need of steps.find((step) => step.name === name).needs ?? []) include(need);
    required.add(name);
  };
  names.forEach(include);
  return steps.filter((step) => required.has(step.name));
}

/** The steps of a quick run, some of which do less; no other step is chosen with them. */
function quickSteps(only) {
  if (only !== undefined) throw new Failure("--quick chooses the steps; leave out --only");
  return steps
    .filter(({ quick }) => quick !== undefined)
    .map(({ quick, needs: _, ...step }) => ({ ...step, ...quick }));
}

async function runStep(step, results, chosen) {
  say(`\n=== ${step.name}: ${step.what}`);
  const failedNeeds = (step.needs ?? []).filter((name) => !results.get(name).ok);
  const start = performance.now();
  let ok = true;
  let output = "";
  let why;
  try {
    if (failedNeeds.length > 0)
      throw new Failure(`not run, because it needs ${failedNeeds.join(", ")}`);
    output = (await step.run(chosen)) ?? "";
    if (step.tests && count(output).passed === 0) {
      throw Object.assign(new Failure("no test was run"), { output });
    }
  } catch (error) {
    ok = false;
    output = error.output ?? "";
    why = error instanceof Failure ? error.message : error.stack;
    say(`FAILED: ${why}`);
  }
  const seconds = (performance.now() - start) / 1000;
  say(`--- ${step.name}: ${ok ? "passed" : "FAILED"} in ${seconds.toFixed(1)} s`);
  const counts = count(output);
  // A step without tests, such as a lint, counts as one test.
  if (ok && counts.passed === 0) counts.passed = 1;
  if (!ok && counts.failed === 0) counts.failed = 1;
  return { ok, why, seconds, ...counts };
}

/**
 * Runs the steps in rows: each after the one before it in its row and those that it needs. As these stand before it in
 * the plan, the first step that has not ended can always run.
 */
async function runAll(plan) {
  const chosen = new Set(plan.map(({ name }) => name));
  const results = new Map();
  const ended = new Map();
  const last = {};
  const after = async (earlier, step) => {
    await Promise.all(earlier);
    if (step.row) say(`\n=== ${step.name} begins beside, and is shown when it ends`);
    const work = () => runStep(step, results, chosen);
    results.set(step.name, await (step.row ? heldBack(work) : work()));
  };
  for (const step of plan) {
    const { row = "compile" } = step;
    const earlier = [last[row], ...(step.needs ?? []).map((name) => ended.get(name))];
    last[row] = after(earlier, step);
    ended.set(step.name, last[row]);
  }
  await Promise.all(ended.values());
  return results;
}

function summary(results) {
  console.log("\n=== summary");
  const total = { passed: 0, failed: 0, skipped: 0 };
  // The slowest first: there time is to be gained.
  const slowest = [...results].sort(([, one], [, other]) => other.seconds - one.seconds);
  for (const [name, { ok, why, seconds, passed, failed, skipped }] of slowest) {
    const verdict = ok ? "passed" : "FAILED";
    const counts = `${passed} passed, ${failed} failed, ${skipped.length} skipped`;
    console.log(`${verdict}  ${name.padEnd(12)} ${seconds.toFixed(1).padStart(7)} s  ${counts}`);
    if (why) console.log(`        ${why.split("\n")[0]}`);
    for (const test of skipped) console.log(`SKIPPED ${name}: ${test}`);
    total.passed += passed;
    total.failed += failed;
    total.skipped += skipped.length;
  }
  console.log(`${total.skipped} skipped`);
  console.log(`${total.passed} passed, ${total.failed} failed`);
  return total.failed === 0;
}

try {
  const plan = chosen();
  await setUpForTests();
  process.exitCode = summary(await runAll(plan)) ? 0 : 1;
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
