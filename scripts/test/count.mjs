// Counts of passed, failed and skipped tests, parsed from the output of the test
// programs.

const esc = String.fromCharCode(27);
const colours = new RegExp(`${esc}\\[[0-9;]*m`, "g");

/** `cargo test` and wasm-bindgen-test-runner. */
const rust = {
  totals: /^test result: .*?(?<passed>\d+) passed; (?<failed>\d+) failed/gm,
  skipped: /^test (.+?) \.\.\. ignored(?:, (.*))?$/gm,
};

/** `node --test` with the reporter `spec`. */
const node = {
  totals: /^ℹ pass (?<passed>\d+)\nℹ fail (?<failed>\d+)\nℹ cancelled (?<cancelled>\d+)/gm,
  skipped: /^\s*﹣ (.+?)(?: \([\d.]+ms\))?(?: # ?(.*))?$/gm,
};

/** `pytest -rs`. */
const python = {
  totals: /^=+ (?:(?<failed>\d+) failed, )?(?<passed>\d+) passed/gm,
  skipped: /^SKIPPED \[\d+\] (.+?): (.*)$/gm,
};

/** Lines with which a test reports that it cannot run here; libtest counts it as passed. */
const own = /^SKIPPED ([^:\n]+): (.*)$/gm;

export function count(output) {
  const text = output.replace(colours, "").replaceAll("\r\n", "\n");
  const sum = { passed: 0, failed: 0 };
  const names = new Set();
  for (const { totals, skipped } of [rust, node, python]) {
    for (const { groups } of text.matchAll(totals)) {
      const { passed, failed = 0, cancelled = 0 } = groups;
      sum.passed += Number(passed);
      sum.failed += Number(failed) + Number(cancelled);
    }
    for (const [, name, reason] of text.matchAll(skipped)) {
      names.add(reason ? `${name} (${reason})` : name);
    }
  }
  const passedBySkipping = new Set();
  for (const [, name, reason] of text.matchAll(own)) {
    passedBySkipping.add(name);
    names.add(`${name} (${reason})`);
  }
  sum.passed = Math.max(0, sum.passed - passedBySkipping.size);
  return { ...sum, skipped: [...names] };
}
