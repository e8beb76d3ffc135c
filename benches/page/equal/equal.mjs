// node benches/page/equal/equal.mjs [MODELS]: opens pairs of files of all formats on the built page and measures
// them by the command, and compares interval, verdict, farthest faces and report. MODELS is a folder with
// more models. Needs `npx vite build www` and the command in target/release.
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { open } from "../../../tests/page/support/open.mjs";
import { pairs } from "./pairs.mjs";

const LIMIT = 0.1;
const WORDS = { passed: "pass", failed: "fail", undecided: "undecided" };

const folder = await mkdtemp(join(tmpdir(), "equal-"));
const opened = await open({ path: `#limit=${LIMIT}&deviation=` });
const { page } = opened;

/** What the command says of two files; its status is the verdict. */
async function commanded(a, b) {
  const args = ["distance", a, b, "--symmetric", "--relative-tolerance", "1e-6", "--format", "json"];
  const run = (more) =>
    promisify(execFile)("target/release/nurbs-hausdorff", [...args, ...more], {
      maxBuffer: 1e8,
    }).catch((error) => {
      if (error.stdout) return error;
      throw error;
    });
  const whole = JSON.parse((await run([])).stdout);
  const judged = JSON.parse((await run(["--limit", `${LIMIT}`])).stdout);
  return { ...whole, verdict: judged.verdict };
}

/** What the page says of two files. */
async function shown(paths) {
  await opened.until("done", () => page.setInputFiles("#file-both", paths));
  await page.locator("#limit").fill(`${LIMIT}`);
  await page.locator('#result[data-state="done"]').waitFor();
  const data = await opened.data();
  const verdict = await page.locator("#badge").textContent();
  const number = await page.locator("#distance").textContent();
  const where = await page.locator("#where").textContent();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#export-report").click(),
  ]);
  return { data, verdict, number, where, report: await readFile(await download.path(), "utf8") };
}

let faults = 0;
let exact = 0;
const all = pairs(process.argv[2]);
try {
  await page.locator('#result[data-state="done"]').waitFor();
  for (const pair of all) {
    const paths = [];
    for (const [index, { name, bytes }] of pair.entries()) {
      const path = join(folder, name.startsWith(index === 0 ? "a." : "b.") ? name : `${index}-${name}`);
      await writeFile(path, bytes);
      paths.push(path);
    }
    const title = pair.map(({ name }) => name).join(" and ");
    const command = await commanded(...paths);
    const { data, verdict, number, where, report } = await shown(paths);
    const [lower, upper] = [Number(data.lower), Number(data.upper)];
    if (lower === command.lower && upper === command.upper) exact += 1;
    const value = Number(number.replace("≤ ", ""));
    const problems = [
      ...(lower > command.upper || command.lower > upper ? ["intervals that have nothing in common"] : []),
      ...(verdict.toLowerCase() === WORDS[command.verdict] ? [] : [`${verdict}, ${command.verdict}`]),
      // An upper bound that is printed is rounded up.
      ...(lower <= value && (value <= upper || number.startsWith("≤")) ? [] : [`${number} outside [${lower}, ${upper}]`]),
      ...(report.includes(`>${verdict}<`) && report.includes(number) ? [] : ["another report"]),
      ...["a", "b"]
        .map((side) => command.witness[side].faceName ?? "")
        .filter((name) => !where.startsWith("The models agree") && !where.includes(name.split(" / ").at(-1)))
        .map((name) => `${where} without ${name}`),
    ];
    faults += problems.length;
    console.log(`${problems.length === 0 ? "equal" : "OTHER"}  ${title}: ${number} ${verdict} ${problems.join("; ")}`);
  }
} finally {
  await opened.close();
  await rm(folder, { recursive: true });
}
console.log(`${all.length} pairs, ${faults} differences; ${exact} intervals equal to the last bit`);
process.exitCode = faults === 0 ? 0 : 1;
