// Reading how many tests passed, failed and were skipped from what their
// programs print. A program that counts nothing is itself one test.

const esc = String.fromCharCode(27);
const colours = new RegExp(`${esc}\\[[0-9;]*m`, "g");

/** `cargo test` and wasm-bindgen-test-runner. */
const rust = {
  totals: /^test result: .*?(\d+) passed; (\d+) failed; (\d+) ignored/gm,
  skipped: /^test (.+?) \.\.\. ignored(?:, (.*))?$/gm,
};

/** `node --test` with the reporter `spec`. */
const node = {
  totals: /^ℹ pass (\d+)\nℹ fail (\d+)\n(?:ℹ cancelled \d+\n)?ℹ skipped (\d+)/gm,
  skipped: /^\s*﹣ (.+?) \([\d.]+ms\) # ?(.*)$/gm,
};

export function count(output, ok) {
  const text = output.replace(colours, "").replaceAll("\r\n", "\n");
  const sum = { passed: 0, failed: 0, skipped: [] };
  for (const { totals, skipped } of [rust, node]) {
    for (const [, passed, failed] of text.matchAll(totals)) {
      sum.passed += Number(passed);
      sum.failed += Number(failed);
    }
    for (const [, name, reason] of text.matchAll(skipped)) {
      sum.skipped.push(reason ? `${name} (${reason})` : name);
    }
  }
  if (ok && sum.passed === 0) sum.passed = 1;
  if (!ok && sum.failed === 0) sum.failed = 1;
  return sum;
}
