import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { inRoot } from "../../../scripts/paths.mjs";
import { file, modelFile, planes } from "../support/models.mjs";
import { open } from "../support/open.mjs";
import { choose, painted, parsed, run, saved, state } from "../support/sweep.mjs";

/** The sweeps of the command line's experiments, and the columns of their tables. */
const plan = JSON.parse(readFileSync(inRoot("examples/experiments/sweep.json"), "utf8"));

let opened;
let page;

before(async () => {
  opened = await open({ webgpu: false, path: "experiments.html" });
  page = opened.page;
  await state(page, "ready");
});

after(() => opened.close());

const notes = (method) => page.locator(`[data-method="${method}"] li`).allTextContents();

test("a square moved past another: the bounds of every method contain the distance of the corners", async () => {
  const methods = ["iteration", "2012 paper: none", "hierarchy", "iteration: tight"];
  const files = [modelFile("a.json", planes(0)), modelFile("b.json", planes(3))];
  await choose(page, { files, methods, positions: "5", samples: "12" });
  await run(page);
  const { name, columns, rows } = await saved(page);
  assert.equal(name, "sweep-own.csv");
  assert.deepEqual(columns, plan.columns);
  assert.equal(rows.length, 5 * 5);
  // A's offset is in units of B's diagonal, and its range is 1.5 times that in which the squares overlap.
  const diagonal = Math.hypot(2, 2);
  rows.forEach(({ position, method, computed, lower, upper, converged, failure }, index) => {
    assert.ok(Math.abs(position - 3 * (((index % 5) * 2) / 4 - 1)) < 1e-12, `${position}`);
    const x = 0.05 * diagonal + position;
    // A's farthest corner leaves B by A's translation in the plane.
    const distance = Math.hypot(x, 0.04 * diagonal, 0.03 * diagonal);
    const what = `${method} at ${position}: ${lower} ${computed} ${upper}, not ${distance}`;
    assert.ok(lower <= distance + 1e-12 && distance <= upper + 1e-12, what);
    // Samples lie on the corners, and a square is flat.
    if (method !== "hierarchy") assert.ok(Math.abs(computed - distance) < 1e-5, what);
    if (method === "certified") assert.ok(upper - lower <= 1e-5 && converged === "yes", what);
    assert.equal(failure, "");
  });
  // The readout shows the values of the table.
  const read = () => page.locator("#readout-rows tr").first().locator("td").allTextContents();
  const written = (row) => `${Number(row.computed.toPrecision(9))}`;
  assert.equal((await read())[1], written(rows[4]), "at the newest position");
  await page.locator("#plot-distance .u-over").hover();
  await page.locator("#at-text", { hasText: /^0$/ }).waitFor();
  assert.equal((await read())[1], written(rows[2]), "at the position under the pointer");
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

test("a failure is a gap with its error code", async () => {
  const fields = { positions: "5", samples: "64", limit: "5", budget: "1" };
  await choose(page, { pair: "nested", methods: ["hierarchy"], ...fields });
  await run(page);
  const { rows } = await saved(page);
  for (const { position, method, lower, upper, failure } of rows) {
    if (failure !== "") continue;
    // The distances of A's points from the centre of B, a sphere of radius 2, lie in [near, far].
    const [near, far] = [Math.abs(Math.abs(position) - 0.2), Math.abs(position) + 0.2];
    const distance = Math.max(2 - near, far - 2);
    const what = `${method} at ${position}: ${lower} ${upper}, not ${distance}`;
    assert.ok(lower <= distance + 1e-12 && distance <= upper + 1e-12, what);
  }
  const codes = rows.filter(({ method }) => method === "hierarchy").map(({ failure }) => failure);
  const failed = "PAIR_BUDGET_EXCEEDED";
  assert.deepEqual(codes, ["", failed, failed, failed, ""]);
  assert.match(
    (await notes("hierarchy"))[0],
    /^PAIR_BUDGET_EXCEEDED at -1.65, 0, 1.65; the first: /,
  );
  // This includes the middle, where all points of A are equally far from B.
  assert.deepEqual(await notes("certified"), []);
  await page.locator("#at").fill("1");
  assert.equal(
    await page.locator("#readout-rows tr").nth(1).locator("td").textContent(),
    "PAIR_BUDGET_EXCEEDED",
  );
  for (const panel of ["time", "distance"]) {
    assert.ok((await painted(page, panel, "certified", 1 / 8)) > 0, `${panel}: a line`);
    assert.equal(await painted(page, panel, "hierarchy", 1 / 8), 0, `${panel}: a gap`);
    assert.ok((await painted(page, panel, "hierarchy", 0)) > 0, `${panel}: a point alone`);
  }
  // In the middle there is no point, only the cross of the failure.
  assert.ok((await painted(page, "time", "hierarchy", 1 / 2)) > 0);
  assert.equal(await painted(page, "distance", "hierarchy", 1 / 2), 0);
  await opened.screenshot("experiments-failures");
});

test("Stop cancels a long run, which adds no row, and the next sweep runs", async () => {
  // 720,000 samples on 5,000 patches each: 3.6 thousand million projections take minutes anywhere.
  const endless = modelFile("endless.json", planes(...Array(5000).keys()));
  const methods = ["2012 paper: none"];
  const fields = { positions: "5", samples: "12", limit: "Infinity" };
  await choose(page, { files: [endless, endless], methods, ...fields });
  await page.locator("#run").click();
  await page.locator("#status", { hasText: /^2012 paper: none at 0$/ }).waitFor();
  assert.ok(await page.locator("#run").isDisabled());
  await page.locator("#stop").click();
  await state(page, "stopped");
  const ran = (await saved(page)).rows.map(({ method, failure }) => `${method}${failure}`);
  assert.deepEqual(ran, [...Array(3).fill("certified"), ...Array(2).fill(`${methods[0]}left-out`)]);
  await choose(page, { pair: "copy", ...fields });
  await run(page);
  const { name, rows } = await saved(page);
  assert.equal(name, "sweep-copy.csv");
  assert.equal(rows.length, 5);
  // In the middle the sheet coincides with its copy.
  assert.ok(rows[2].lower === 0 && rows[2].upper < 1e-5, `${rows[2].lower} ${rows[2].upper}`);
});

test("a method that is too slow for the page is run only in the middle, and only as published", async () => {
  const many = modelFile("many.json", planes(...Array(72).keys()));
  const methods = ["2012 paper: none", "2012 paper: loose"];
  const fields = { positions: "5", samples: "64", limit: "Infinity" };
  await choose(page, { files: [many, many], methods, ...fields });
  await run(page);
  // 72 squares of 64 x 64 samples, each to be projected on 72 squares: more than 20 million.
  const found = "left out: 294,912 samples on 72 patches";
  assert.deepEqual(await notes(methods[0]), [`${found}: too slow except at the middle position`]);
  assert.deepEqual(await notes(methods[1]), [`${found} or more: too slow for a sweep`]);
  const { rows } = await saved(page);
  const rowsOf = (name) => rows.filter(({ method }) => method === name);
  const failures = (method) => rowsOf(method).map(({ failure }) => failure);
  assert.deepEqual(failures(methods[0]), ["left-out", "left-out", "", "left-out", "left-out"]);
  assert.deepEqual(failures(methods[1]), Array(5).fill("left-out"));
  // As above, with the diagonal of the stack, whose squares are up to 71 apart.
  const diagonal = Math.hypot(2, 2, 71);
  const distance = Math.hypot(0.05 * diagonal, 0.04 * diagonal, 0.03 * diagonal);
  const { computed } = rowsOf(methods[0])[2];
  assert.ok(Math.abs(computed - distance) < 1e-4, `${computed}, not ${distance}`);
});

test("opened files replace the substitute shapes, and a body is the first surface of its file", async () => {
  const fresh = await open({ webgpu: false, path: "experiments.html" });
  const { page } = fresh;
  const names = () =>
    Promise.all(["a", "b"].map((side) => page.locator(`#name-${side}`).textContent()));
  try {
    await state(page, "ready");
    await choose(page, { pair: "several", positions: "5" });
    assert.deepEqual(await names(), [
      "Cylinder, in place of duck.json",
      "Wing, NACA 2412, in place of utah_teapot_4nurbs.json",
    ]);
    await run(page);
    assert.ok((await saved(page)).rows.every(({ converged }) => converged === "yes"));

    await choose(page, { pair: "body" });
    assert.deepEqual(await names(), [
      "Bottle, in place of duck.json",
      "Bottle, in place of duck.json",
    ]);
    await page.setInputFiles("#file-a", modelFile("duck.json", planes(0, 7)));
    assert.deepEqual(await names(), ["duck.json, first surface", "duck.json, first surface"]);
    await run(page);
    const { name, rows } = await saved(page);
    assert.equal(name, "sweep-body.csv");
    assert.equal(rows.length, 5);
    // One square moved past its copy, as above; with the second surface the diagonal would differ.
    const diagonal = Math.hypot(2, 2);
    for (const { position, lower, upper } of rows) {
      const x = 0.05 * diagonal + position;
      const distance = Math.hypot(x, 0.04 * diagonal, 0.03 * diagonal);
      const what = `${lower} ${upper}, not ${distance}`;
      assert.ok(lower <= distance + 1e-12 && distance <= upper + 1e-12, what);
    }

    // The teapot still has its substitute; for a pair without substitutes a file selects the own pair.
    await choose(page, { pair: "several" });
    assert.deepEqual((await names())[0], "duck.json");
    assert.match((await names())[1], /^Wing/);
    await choose(page, { pair: "small" });
    assert.deepEqual(await names(), ["Net of 6 x 6", "Net of 6 x 6, other waves"]);
    await page.setInputFiles("#file-b", modelFile("other.json", planes(3)));
    assert.equal(await page.locator("#pair").inputValue(), "own");
    assert.deepEqual(await names(), ["duck.json", "other.json"]);
  } finally {
    await fresh.close();
  }
});

test("if the patches of B cannot be counted, methods that project on all of them fail with the error code", async () => {
  /** Makes the count, a measurement with 2 x 2 samples, fail like a GPU. */
  const prepare = (page) =>
    page.addInitScript(() => {
      globalThis.Worker = class extends Worker {
        postMessage(request) {
          if (request.options?.samples !== 2) super.postMessage(request);
          else {
            const data = {
              kind: "failed",
              run: request.run,
              code: "GPU_FAILED",
              message: "on purpose",
            };
            this.onmessage({ data });
          }
        }
      };
    });
  const fresh = await open({ webgpu: false, path: "experiments.html", prepare });
  try {
    await state(fresh.page, "ready");
    const methods = ["iteration", "2012 paper: none"];
    await choose(fresh.page, { pair: "small", methods, positions: "5", samples: "12" });
    await run(fresh.page);
    const { rows } = await saved(fresh.page);
    assert.equal(rows.length, 15);
    for (const { method, failure } of rows) {
      assert.equal(failure, method === "2012 paper: none" ? "GPU_FAILED" : "", method);
    }
    const note = await fresh.page.locator('[data-method="2012 paper: none"] li').textContent();
    assert.match(
      note,
      /^GPU_FAILED at 5 positions; the first: the patches of B could not be counted: on purpose$/,
    );
  } finally {
    await fresh.close();
  }
});

test("a file of no known format is reported with the formats read, and can be replaced", async () => {
  const good = modelFile("good.json", planes(0));
  await choose(page, { files: [file("broken.json", "not JSON"), good], positions: "5" });
  await page.locator("#run").click();
  await page.locator('#error[data-code="FORMAT_UNSUPPORTED"]').waitFor();
  assert.match(
    await page.locator("#error").textContent(),
    /^FORMAT_UNSUPPORTED: broken\.json: .*read are STEP, IGES.* and interchange JSON/,
  );
  await page.setInputFiles("#file-a", good);
  await run(page);
  assert.ok(await page.locator("#error").isHidden());
});

const commandLine = inRoot("target/release/examples/experiments");
const unbuilt = !existsSync(commandLine) && "the example experiments is not built";

test("the table equals that of the command line", { skip: unbuilt }, async () => {
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
  theirs.rows.forEach((expected, index) => {
    const found = ours.rows[index];
    assert.equal(found.method, expected.method);
    // Columns that depend neither on the GPU's rounding nor on details of the search.
    for (const column of ["position", "computed", "k_a", "patches_of_b"]) {
      const what = `${expected.method} at ${expected.position}: ${column} ${found[column]}`;
      if (expected[column] === "") assert.equal(found[column], "", what);
      else assert.ok(Math.abs(found[column] - expected[column]) < 1e-4, what);
    }
  });
});

test("the two pages lead to each other", async () => {
  await page.getByRole("link", { name: "one pair in 3D" }).click();
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
