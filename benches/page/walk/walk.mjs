// node benches/page/walk/walk.mjs [--pictures DOCS/IMAGES] [A B [ALLOWED]]: a newcomer's way from two
// files to a printed report on the built page (`npx vite build www`), in headless Chromium, with
// only what is seen on the page. Prints the seconds of each step, those of the person among them
// (`person.mjs`), and how often the panel was scrolled; without files, of two brackets.
// `--pictures` keeps pictures of the steps, made small by pngquant where it is installed.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { parseArgs } from "node:util";
import { which } from "../../../scripts/process.mjs";
import { open } from "../../../tests/page/support/open.mjs";
import { writeBrackets } from "./brackets.mjs";
import { Person } from "./person.mjs";

/** The window, in pixels: a small laptop's, and small pictures. */
const SIZE = { width: 1130, height: 760 };
/** Milliseconds in which a picture is looked at. */
const LOOK = 2000;
/** The colours of a picture. */
const COLORS = 128;

const { values, positionals } = parseArgs({
  options: { pictures: { type: "string" } },
  allowPositionals: true,
});
const folder = await mkdtemp(join(tmpdir(), "walk-"));
const [a, b] = positionals.length >= 2 ? positionals : await writeBrackets(folder);
const allowed = positionals[2] ?? "0.2";
const begun = performance.now();
const opened = await open({ path: "", size: SIZE, unfolded: false });
const { page } = opened;
const person = new Person(page);
const button = (name, from = page) => from.getByRole("button", { name, exact: true });

let count = 0;
let last = performance.now();
const steps = [];

/** Notes what a step took, and keeps a picture where it has a name, which takes no time of the walk. */
async function step(what, { name, from = page } = {}) {
  const { turns, spent } = person;
  steps.push({ what, turns, seconds: (performance.now() - last) / 1000, own: spent / 1000 });
  Object.assign(person, { turns: 0, spent: 0 });
  if (name !== undefined && values.pictures !== undefined) await picture(from, name);
  last = performance.now();
}

async function picture(from, name) {
  count += 1;
  const path = join(values.pictures, `walk-${count}-${name}.png`);
  writeFileSync(path, await from.screenshot());
  if (which("pngquant") === undefined) return;
  execFileSync("pngquant", ["--force", "--skip-if-larger", "--output", path, `${COLORS}`, path]);
}

async function walk() {
  const card = page.getByRole("region", { name: "Verdict" });

  // What the page is about is read while the example is measured.
  const title = page.getByRole("heading", { level: 1 });
  await person.read(title.locator(".."));
  await step("open the page, read its title", { name: "first-screen" });

  const files = [a, b].map((file) => ({
    name: basename(file),
    base64: readFileSync(file).toString("base64"),
  }));
  await person.drop(page.getByText("Drop two files here, or choose"), files);
  await page.getByRole("combobox", { name: "Model B" }).locator("option:checked", { hasText: basename(b) }).waitFor({ state: "attached" });
  await card.getByText(/^No verdict/).waitFor();
  await person.wait(LOOK);
  await step("drop two files, see them");

  await person.type(page.getByRole("spinbutton", { name: "+/−" }), allowed);
  await step(`allow ${allowed}`);

  const verdict = await person.read(card.getByText(/^(PASS|FAIL|UNDECIDED)$/).locator(".."));
  const where = await person.glance(card.getByText(/^Farthest/));
  const said = [verdict, where].join(", ").replace(/\s+/g, " ");
  await step(`read the verdict: ${said}`, { name: "verdict" });

  await person.click(button("Next place"));
  await person.wait(LOOK);
  await step("go to the worst place, look", { name: "worst-place" });

  await person.click(button("Add to report"));
  await button("Add to report (1)").waitFor();
  await step("add the view to the report", { name: "view-added" });

  const [report] = await Promise.all([
    page.waitForEvent("popup"),
    person.click(button("Open the report")),
  ]);
  const print = button("Print, or save as PDF", report);
  await print.waitFor();
  await person.wait(LOOK);
  await step("open the report, look", { name: "report", from: report });

  // A headless browser has no dialog, and prints nothing by itself: the page's call is noted.
  await report.evaluate(() => {
    window.print = () => document.body.toggleAttribute("data-printed", true);
  });
  const reader = new Person(report);
  await reader.click(print);
  person.spent += reader.spent;
  await report.locator("body[data-printed]").waitFor();
  const pdf = await report.pdf({ preferCSSPageSize: true });
  // In the dialog a button is found and pressed.
  await person.wait(LOOK);
  await step("print it");
  return pdf;
}

try {
  console.log(`${((last - begun) / 1000).toFixed(1)} s to start the browser, not of the walk`);
  last = performance.now();
  const pdf = await walk();
  const inAll = (of) => steps.reduce((sum, step) => sum + step[of], 0);
  const row = (seconds, own, what) => {
    console.log(`${seconds.toFixed(1).padStart(5)} s, ${own.toFixed(1).padStart(4)} s of them the person's: ${what}`);
  };
  for (const { what, seconds, own, turns } of steps) {
    row(seconds, own, turns > 0 ? `${what} (${turns} turns of the wheel)` : what);
  }
  row(inAll("seconds"), inAll("own"), `in all; ${(pdf.length / 1024).toFixed(0)} KiB of PDF`);
  if (opened.errors.length > 0) throw new Error(opened.errors.join("\n"));
} finally {
  await opened.close();
  await rm(folder, { recursive: true });
}
