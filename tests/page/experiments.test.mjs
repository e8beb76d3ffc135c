import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { inRoot } from "../../scripts/paths.mjs";
import { file, modelFile, planes } from "./models.mjs";
import { open } from "./open.mjs";
import { choose, painted, parsed, run, saved, state } from "./sweep.mjs";

const COLUMNS =
  "position,method,computed,lower,upper,k_a,k_a_rigorous,k_b,converged,seconds_solve,seconds_prepare,cells,patches_of_b,failure";

let opened;
let page;

before(async () => {
  opened = await open({ webgpu: false, path: "experiments.html" });
  page = opened.page;
  await state(page, "ready");
});

after(() => opened.close());

const notes = (method) => page.locator(`[data-method="${method}"] li`).allTextContents();

test("a square past another: every method's curve has the corners' distance in its bounds", async () => {
  const methods = ["iteration", "2012 paper: none", "hierarchy", "iteration: tight"];
  const files = [modelFile("a.json", planes(0)), modelFile("b.json", planes(3))];
  await choose(page, { files, methods, positions: "5", samples: "12" });
  await run(page);
  const { name, columns, rows } = await saved(page);
  assert.equal(name, "sweep-own.csv");
  assert.equal(columns.join(","), COLUMNS);
  assert.equal(rows.length, 5 * 5);
  // B's diagonal, by whose parts A passes aside; A reaches 1.5 times where the squares part.
  const diagonal = Math.hypot(2, 2);
  rows.forEach(({ position, method, computed, lower, upper, converged, failure }, index) => {
    assert.ok(Math.abs(position - 3 * (((index % 5) * 2) / 4 - 1)) < 1e-12, `${position}`);
    const x = 0.05 * diagonal + position;
    // A's farthest corner is as far beside B as A is moved in the plane.
    const distance = Math.hypot(x, 0.04 * diagonal, 0.03 * diagonal);
    const what = `${method} at ${position}: ${lower} ${computed} ${upper}, not ${distance}`;
    assert.ok(lower <= distance + 1e-12 && distance <= upper + 1e-12, what);
    // Samples lie on the corners, and a square is flat.
    if (method !== "hierarchy") assert.ok(Math.abs(computed - distance) < 1e-5, what);
    if (method === "certified") assert.ok(upper - lower <= 1e-5 && converged === "yes", what);
    assert.equal(failure, "");
  });
  // What is read at a position is what is in the table.
  const read = () => page.locator("#reading-rows tr").first().locator("td").allTextContents();
  const written = (row) => `${Number(row.computed.toPrecision(9))}`;
  assert.equal((await read())[1], written(rows[4]), "at the newest position");
  await page.locator("#plot-distance .u-over").hover();
  await page.locator("#at-text", { hasText: /^0$/ }).waitFor();
  assert.equal((await read())[1], written(rows[2]), "where the mouse points");
  await opened.screenshot("experiments-squares");
});

test("the time axis is logarithmic or linear", async () => {
  const drawn = () => page.evaluate(() => document.querySelector("#plot-time canvas").toDataURL());
  const logarithmic = await drawn();
  await page.locator("#logarithmic-time").uncheck();
  await page.waitForFunction(
    (before) => document.querySelector("#plot-time canvas").toDataURL() !== before,
    logarithmic,
  );
  await page.locator("#logarithmic-time").check();
});

test("a failing method is a gap with its code", async () => {
  const fields = { positions: "5", samples: "64", limit: "5", budget: "1" };
  await choose(page, { pair: "nested", methods: ["hierarchy"], ...fields });
  await run(page);
  const { rows } = await saved(page);
  for (const { position, method, lower, upper, failure } of rows) {
    if (failure !== "") continue;
    // Points of A are between these far from the centre of the sphere of radius 2.
    const [near, far] = [Math.abs(Math.abs(position) - 0.2), Math.abs(position) + 0.2];
    const distance = Math.max(2 - near, far - 2);
    const what = `${method} at ${position}: ${lower} ${upper}, not ${distance}`;
    assert.ok(lower <= distance + 1e-12 && distance <= upper + 1e-12, what);
  }
  const codes = rows.filter(({ method }) => method === "hierarchy").map(({ failure }) => failure);
  const failed = "PAIR_BUDGET_EXCEEDED";
  assert.deepEqual(codes, ["", failed, failed, failed, ""]);
  assert.match((await notes("hierarchy"))[0], /^PAIR_BUDGET_EXCEEDED at -1.65, 0, 1.65; first: /);
  // Also in the middle, where all of B is equally far from all of A.
  assert.deepEqual(await notes("certified"), []);
  await page.locator("#at").fill("1");
  assert.equal(
    await page.locator("#reading-rows tr").nth(1).locator("td").textContent(),
    "PAIR_BUDGET_EXCEEDED",
  );
  for (const panel of ["time", "distance"]) {
    assert.ok((await painted(page, panel, "certified", 1 / 8)) > 0, `${panel}: a line`);
    assert.equal(await painted(page, panel, "hierarchy", 1 / 8), 0, `${panel}: a gap`);
    assert.ok((await painted(page, panel, "hierarchy", 0)) > 0, `${panel}: a point alone`);
  }
  // In the middle is no point, but the cross of the failure.
  assert.ok((await painted(page, "time", "hierarchy", 1 / 2)) > 0);
  assert.equal(await painted(page, "distance", "hierarchy", 1 / 2), 0);
  await opened.screenshot("experiments-failures");
});

test("Stop ends a long run, which leaves no row, and the next sweep runs", async () => {
  const fields = { positions: "5", samples: "12", limit: "Infinity" };
  await choose(page, { pair: "nested", ...fields });
  await page.locator("#run").click();
  await page.locator("#status", { hasText: /^certified at 0$/ }).waitFor();
  assert.ok(await page.locator("#run").isDisabled());
  const begin = performance.now();
  await page.locator("#stop").click();
  await state(page, "stopped");
  assert.ok(performance.now() - begin < 3000, "it stops at once");
  assert.deepEqual(
    (await saved(page)).rows.map(({ position }) => position.toFixed(6)),
    ["-3.300000", "-1.650000"],
  );
  await choose(page, { pair: "copy", ...fields });
  await run(page);
  const { name, rows } = await saved(page);
  assert.equal(name, "sweep-copy.csv");
  assert.equal(rows.length, 5);
  // The sheet in its own place.
  assert.ok(rows[2].lower === 0 && rows[2].upper < 1e-5, `${rows[2].lower} ${rows[2].upper}`);
});

test("what a page cannot afford is left out, with the reason", async () => {
  const many = modelFile("many.json", planes(...Array.from({ length: 72 }, (_, index) => index)));
  const methods = ["2012 paper: none"];
  await choose(page, { files: [many, many], methods, positions: "5", samples: "64" });
  await run(page);
  // 72 squares of 64 x 64 samples, each to be projected on 72 squares: more than 20 million.
  assert.deepEqual(await notes("2012 paper: none"), [
    "left out: 294,912 samples on 72 patches or more: too long for a page",
  ]);
  const { rows } = await saved(page);
  const left = rows.filter(({ failure }) => failure === "left-out");
  assert.equal(left.length, 5);
  assert.ok(left.every(({ method, computed }) => method === methods[0] && computed === ""));
});

test("a broken file is told by its code, and can be replaced", async () => {
  const good = modelFile("good.json", planes(0));
  await choose(page, { files: [file("broken.json", "not JSON"), good], positions: "5" });
  await page.locator("#run").click();
  await page.locator('#error[data-code="JSON_SHAPE"]').waitFor();
  assert.match(await page.locator("#error").textContent(), /^JSON_SHAPE: broken.json: /);
  await page.setInputFiles("#file-a", good);
  await run(page);
  assert.ok(await page.locator("#error").isHidden());
});

const commandLine = inRoot("target/release/examples/experiments");
const unbuilt = !existsSync(commandLine) && "the example experiments is not built";

test("the table is the command line's", { skip: unbuilt }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "experiments-"));
  const options = ["--out", folder, "--quick", "--only", "sweep-small"];
  execFileSync(commandLine, options, { stdio: "ignore" });
  const theirs = parsed(readFileSync(join(folder, "sweep-small.csv"), "utf8"));
  rmSync(folder, { recursive: true });
  const methods = [...new Set(theirs.rows.map(({ method }) => method))].slice(1);
  await choose(page, { pair: "small", methods, positions: "5", samples: "12", budget: "256" });
  await run(page);
  const ours = await saved(page);
  assert.deepEqual(ours.columns, theirs.columns);
  assert.equal(ours.rows.length, theirs.rows.length);
  theirs.rows.forEach((wanted, index) => {
    const found = ours.rows[index];
    assert.equal(found.method, wanted.method);
    // What a GPU's rounding, or an example built before the last change, leaves as it is.
    for (const column of ["position", "computed", "k_a", "patches_of_b"]) {
      const what = `${wanted.method} at ${wanted.position}: ${column} ${found[column]}`;
      if (wanted[column] === "") assert.equal(found[column], "", what);
      else assert.ok(Math.abs(found[column] - wanted[column]) < 1e-4, what);
    }
  });
});

test("the two pages lead to each other", async () => {
  await page.getByRole("link", { name: "one pair, in 3D" }).click();
  await page.getByRole("link", { name: "experiments" }).click();
  await state(page, "ready");
});

test("it is usable on a phone", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await choose(page, { pair: "small", methods: ["hierarchy"], positions: "5", samples: "12" });
  await run(page);
  const [content, widest] = await page.evaluate(() => [
    document.documentElement.scrollWidth,
    Math.max(...Array.from(document.querySelectorAll(".plot canvas"), (one) => one.clientWidth)),
  ]);
  assert.ok(content <= 390 && widest > 300 && widest <= 390, `${content} ${widest}`);
  await page.locator("#plot-time").scrollIntoViewIfNeeded();
  await opened.screenshot("experiments-phone");
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
