// Inspection on the page: verdict, colours, points, views, position, state and exports.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { validateBytes } from "gltf-validator";
import { Box3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { drawn } from "./support/drawn.mjs";
import { modelFile, planes } from "./support/models.mjs";
import { open } from "./support/open.mjs";

let opened;

before(async () => {
  opened = await open();
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** Opens squares at these heights; `more` is of each model, and `each` of each of its surfaces. */
async function openPlanes(a, b, more = {}, each = {}) {
  for (const [side, heights] of Object.entries({ a, b })) {
    const surfaces = planes(...heights).surfaces.map((surface) => ({ ...surface, ...each }));
    const model = { surfaces, ...more };
    await opened.until("done", () =>
      opened.page.setInputFiles(`#file-${side}`, modelFile(`${side}.json`, model)),
    );
  }
}

const text = (selector) => opened.page.locator(selector).textContent();

/** Waits until an element's text matches. */
const reads = (selector, pattern) =>
  opened.page.waitForFunction(
    ([selector, source]) => new RegExp(source).test(document.querySelector(selector).textContent),
    [selector, pattern.source],
  );

/** The file that a button exports. */
async function exported(id) {
  const [download] = await Promise.all([
    opened.page.waitForEvent("download"),
    opened.page.locator(id).click(),
  ]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

test("an allowed distance passes or fails by the interval, and is undecided inside it", async () => {
  const { page } = opened;
  await openPlanes([0], [0.25]);
  const { lower, upper } = await opened.data();
  assert.ok(Number(lower) <= 0.25 && 0.25 <= Number(upper));
  for (const [allowed, verdict] of [
    ["0.3", "pass"],
    ["0.2", "fail"],
    [upper, "pass"],
    ...(Number(lower) < Number(upper) ? [[lower, "undecided"]] : []),
  ]) {
    await page.locator("#limit").fill(allowed);
    assert.equal(await page.locator("#verdict").getAttribute("data-verdict"), verdict);
    assert.equal(await text("#badge"), verdict.toUpperCase());
  }
  await page.locator("#limit").fill("");
  assert.equal(await text("#verdict"), "");
});

test("a verdict says that the files' gaps could change it", async () => {
  const { page } = opened;
  await openPlanes([0], [0.25], {}, { gap: 0.03 });
  for (const [allowed, verdict, doubt] of [
    ["0.3", "pass", true],
    ["0.4", "pass", false],
    ["0.2", "fail", true],
    ["0.1", "fail", false],
  ]) {
    await page.locator("#limit").fill(allowed);
    assert.equal(await page.locator("#verdict").getAttribute("data-verdict"), verdict);
    assert.equal(/gaps of the files \(.*0\.06/.test(await text("#verdict")), doubt, allowed);
  }
  await page.locator("#limit").fill("");
});

test("the address of a pair of files names them beside what is allowed of them", async () => {
  const { page } = opened;
  await openPlanes([0], [0.25]);
  await page.locator("#limit").fill("0.6");
  await opened.until("done", () => page.locator("#symmetric").check());
  await page.waitForFunction(() => !location.hash.includes("symmetric="));
  const parameters = await page.evaluate(() => location.hash.slice(1));
  const [a, b, limit] = ["file-a", "file-b", "limit"].map((name) =>
    new URLSearchParams(parameters).get(name),
  );
  assert.deepEqual([a, b, limit], ["a.json", "b.json", "0.6"]);
  await page.locator("#limit").fill("");
  await opened.until("done", () => page.locator("#symmetric").uncheck());
});

test("the area beyond the limit and the histogram follow the samples", async () => {
  const { page } = opened;
  // One square of A lies on B's, the other 0.5 above: half of A's area is out of 0.1.
  await openPlanes([0, 0.5], [0]);
  await opened.until("done", () => page.locator("#deviation").check());
  await page.locator("#limit").fill("0.1");
  assert.match(await text("#beyond-limit"), /A: ≈ 50\.0 % of the area is beyond \(4\.0000/);
  const bars = await page
    .locator("#histogram rect:not(.target)")
    .evaluateAll((all) => all.map((bar) => Number(bar.getAttribute("width"))));
  const long = bars.flatMap((width, bin) => (width > 0 ? [bin] : []));
  assert.deepEqual(long, [0, bars.length - 1], "half at 0, half at the end");
  await page.locator("#limit").fill("0.6");
  assert.match(await text("#beyond-limit"), /≈ 0\.0 %/);
  await opened.screenshot("beyond-limit");
});

test("the legend's range, kind and steps are the user's", async () => {
  const { page } = opened;
  await page.locator("#scale-range").fill("2");
  assert.equal(await text("#scale-high"), "+2.00000");
  assert.equal(await text("#scale-low"), "0.00000");
  await page.selectOption("#scale-kind", "absolute");
  assert.equal(await text("#scale-high"), "2.00000");
  await page.selectOption("#scale-steps", "5");
  const gradient = await page
    .locator("#scale")
    .evaluate((node) => getComputedStyle(node).backgroundImage);
  const colors = new Set(gradient.match(/rgb\([^)]*\)/g));
  assert.ok(colors.size <= 7, `${colors.size} colours`);
  await page.locator("#scale-range").fill("");
  await page.selectOption("#scale-kind", "signed");
  await page.selectOption("#scale-steps", "0");
});

test("identical models have one neutral colour and an upper bound", async () => {
  const { page } = opened;
  await page.locator("#limit").fill("");
  await opened.until("done", () => page.locator("#deviation").uncheck());
  await opened.until("done", () => page.selectOption("#preset", { label: "Torus and moved copy" }));
  for (const axis of ["x", "y", "z"]) {
    await opened.until("done", () => page.locator(`#move-${axis}-exact`).fill("0"));
  }
  await opened.until("done", () => page.locator("#deviation").check());
  assert.match(await text("#distance"), /^(0|≤ \d\.\de-\d+)$/);
  const bars = await page
    .locator("#histogram rect:not(.target)")
    .evaluateAll((all) =>
      all.flatMap((bar) =>
        Number(bar.getAttribute("width")) > 0 ? [bar.getAttribute("fill")] : [],
      ),
    );
  assert.equal(new Set(bars).size, 1, bars.join(" "));
  await opened.screenshot("identical");
  await opened.until("done", () => page.locator("#deviation").uncheck());
});

test("a clicked point is pinned with its distance, face and parameters, and removed", async () => {
  const { page } = opened;
  await openPlanes([0], [0.25]);
  await page.selectOption("#show-b", "hidden");
  await page.selectOption("#direction", "top");
  // At once: the shaders of the new models may still be compiled, and nothing of them drawn.
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  await page.mouse.click(x + 0.5 * width, y + 0.55 * height);
  const pin = page.locator(".pin");
  await pin.waitFor();
  const shown = await pin.textContent();
  assert.match(shown, /^−0\.25000/, "below B, against its normal");
  const number = "(-?\\d[\\d.]*)";
  const numbers = `A face 0 · u ${number} · v ${number}foot on B face 0: ${number}, ${number}, 0\\.25`;
  const [, u, v, east, north] = new RegExp(numbers).exec(shown).map(Number);
  // The square is from -1 to 1. What lies over the view decides where in it its middle is.
  assert.ok(Math.abs(2 * u - 1 - east) < 1e-4 && Math.abs(2 * v - 1 - north) < 1e-4, shown);
  await opened.screenshot("pinned");
  await pin.locator("button").click();
  assert.equal(await pin.count(), 0);
  await page.locator("#canvas").focus();
  await page.keyboard.press("Enter");
  await pin.waitFor();
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.1"));
  assert.equal(await pin.count(), 0, "a point is of the position where it was measured");
  await page.selectOption("#show-b", "glass");
});

test("a resting pointer shows the distance there", async () => {
  const { page } = opened;
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  await page.mouse.move(x + 0.5 * width, y + 0.5 * height);
  await page.locator("#hover").waitFor();
  assert.match(await text("#hover"), /0\.25000/);
  await page.mouse.move(x + 5, y + height - 5);
  await page.locator("#hover").waitFor({ state: "hidden" });
});

test("undo and redo go through positions and options, and the address keeps them", async () => {
  const { page } = opened;
  await opened.until("done", () => page.selectOption("#preset", { label: "Torus and moved copy" }));
  // What rests is a step of its own, and is then in the address.
  await page.waitForFunction(() => location.hash.includes("a=torus"));
  await opened.until("done", () => page.locator("#turn-x-exact").fill("30"));
  await page.waitForFunction(() => location.hash.includes("turn-x=30"));
  await opened.until("done", () => page.locator("#symmetric").check());
  await page.waitForFunction(() => !location.hash.includes("symmetric"));
  const { computed } = await opened.data();
  const url = page.url();
  assert.match(url, /turn-x=30/);
  assert.doesNotMatch(url, /symmetric/);
  await opened.until("done", () => page.locator("#undo").click());
  assert.ok(!(await page.locator("#symmetric").isChecked()));
  await opened.until("done", () => page.locator("#undo").click());
  assert.equal(await page.locator("#turn-x-exact").inputValue(), "0");
  await page.locator("#canvas").focus();
  await opened.until("done", () => page.keyboard.press("Control+Shift+Z"));
  assert.equal(await page.locator("#turn-x-exact").inputValue(), "30");
  await page.goto("about:blank");
  await page.goto(url);
  await page.locator('#result[data-state="done"]').waitFor();
  await reads("#kind", /Symmetric/);
  assert.equal(await page.locator("#turn-x-exact").inputValue(), "30");
  assert.equal(await page.locator("#shape-a").inputValue(), "torus");
  const again = Number((await opened.data()).computed);
  assert.ok(Math.abs(again - Number(computed)) < 1e-4, `${again} ${computed}`);
});

test("section, standard views, handles and a parallel projection are drawn", async () => {
  const { page } = opened;
  await page.selectOption("#section-axis", "1");
  await page.locator("#section-controls").waitFor();
  await page.locator("#orthographic").check();
  await page.selectOption("#gizmo", "rotate");
  await page.selectOption("#direction", "front");
  await opened.screenshot("section");
  await page.selectOption("#section-axis", "");
  assert.ok(await page.locator("#section-controls").isHidden());
  await page.selectOption("#gizmo", "none");
  await page.locator("#orthographic").uncheck();
});

test("a result is exported as JSON, CSV, PNG, glTF and a report", async () => {
  const { page } = opened;
  await page.locator("#export-csv").click();
  await reads("#export-note", /show its colours first/);
  await opened.until("done", () => page.locator("#deviation").check());
  const json = await exported("#export-json");
  const { result, models } = JSON.parse(json.bytes.toString());
  const { lower } = await opened.data();
  assert.equal(result.lower, Number(lower));
  assert.deepEqual(models, { a: "torus", b: "torus" });
  const csv = (await exported("#export-csv")).bytes.toString().trim().split("\n");
  assert.match(csv[0], /^side,face,x,y,z,foot_x/);
  const [, , x, y, z, fx, fy, fz, distance] = csv[1].split(",").map(Number);
  assert.ok(Math.abs(Math.hypot(x - fx, y - fy, z - fz) - distance) < 1e-9);
  // The farthest point is a sample, wherever it is between those of the grid.
  const distances = csv.slice(1).map((line) => Number(line.split(",")[8]));
  assert.equal(Math.max(...distances), result.computed);
  const png = await exported("#export-png");
  assert.equal(png.bytes.subarray(1, 4).toString(), "PNG");
  const gltf = await exported("#export-gltf");
  assert.equal(gltf.bytes.subarray(0, 4).toString(), "glTF");
  const scene = JSON.parse(gltf.bytes.subarray(20, 20 + gltf.bytes.readUInt32LE(12)).toString());
  assert.ok(scene.meshes.some(({ primitives }) => "COLOR_0" in primitives[0].attributes));
  assert.ok(scene.materials.every(({ doubleSided }) => doubleSided));
  const { issues } = await validateBytes(new Uint8Array(gltf.bytes));
  assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0], JSON.stringify(issues.messages));
  const report = (await exported("#export-report")).bytes.toString();
  for (const part of ["data:image/png;base64,", "<svg", "torus", "Symmetric distance"]) {
    assert.ok(report.includes(part), part);
  }
});

/** The box of a glTF file, as three's loader places it. */
async function gltfBox(bytes) {
  const { scene } = await new GLTFLoader().parseAsync(new Uint8Array(bytes).buffer, "");
  scene.updateMatrixWorld(true);
  return new Box3().setFromObject(scene);
}

test("glTF has metres, y up and the models' own place", async () => {
  // Squares of side 2 about (0, 0, 0) and 2 above it, in units of half a metre.
  await openPlanes([0, 2], [0], { unit: 0.5 });
  const { min, max } = await gltfBox((await exported("#export-gltf")).bytes);
  assert.deepEqual(
    [...min.toArray(), ...max.toArray()].map((value) => Math.round(1e6 * value) / 1e6 + 0),
    [-0.5, 0, -0.5, 0.5, 1, 0.5],
  );
});

test("a position without end is cut to one that the view can show, and left again", async () => {
  const { page, until } = opened;
  await until("done", () => page.locator("#move-x-exact").fill("1e300"));
  const value = Number(await page.locator("#move-x-exact").inputValue());
  assert.ok(1e6 < value && value < 1e20, `${value}`);
  for (const view of ["front", "top"]) await page.selectOption("#direction", view);
  await page.locator("#fit").click();
  await drawn(page);
  await until("done", () => page.locator("#move-x-exact").fill("0"));
  await page.locator("#fit").click();
  const labels = await page.locator("#axes text").first().getAttribute("x");
  assert.ok(Number.isFinite(Number(labels)), labels);
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
