// The page in Firefox: every method on the CPU where there is no WebGPU, and files.
import assert from "node:assert/strict";
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { inRoot } from "../../scripts/paths.mjs";
import { which } from "../../scripts/process.mjs";
import { openFirefox } from "./support/firefox.mjs";
import { planes } from "./support/models.mjs";

const executable = which("firefox") ?? which("firefox-esr");
const skip = executable === undefined && "Firefox is not installed";

let opened;

before(async () => {
  if (!skip) opened = await openFirefox(executable);
});

after(() => opened?.close());

/** Waits until the panel of results reaches this state after `change`, a function of the page. */
async function done(change, ...args) {
  await opened.evaluate(() => {
    document.getElementById("result").dataset.state = "awaited";
  });
  await opened.evaluate(change, ...args);
  await opened.until(() => document.getElementById("result").dataset.state === "done");
}

const result = () => opened.evaluate(() => ({ ...document.getElementById("result").dataset }));

/** Selects an entry by its value or text, as a user does. */
function select(id, entry) {
  const list = document.getElementById(id);
  const option = [...list.options].find(({ value, text }) => value === entry || text === entry);
  list.value = option.value;
  for (const type of ["input", "change"]) list.dispatchEvent(new Event(type, { bubbles: true }));
}

test("Firefox measures the first preset", { skip }, async () => {
  await opened.until(() => document.getElementById("result").dataset.state === "done");
  const { lower, upper } = await result();
  assert.ok(0 < Number(lower) && Number(lower) <= Number(upper), `${lower} ${upper}`);
  assert.ok(await opened.evaluate(() => document.getElementById("error").hidden));
});

/** The share of the view in a picture of the window that is of a colour. */
async function coloured(picture) {
  const image = new Image();
  image.src = `data:image/png;base64,${picture}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  const { left, top, width, height } = document.getElementById("stage").getBoundingClientRect();
  const scale = image.width / innerWidth;
  [canvas.width, canvas.height] = [width, height].map((size) => Math.floor(size * scale));
  const context = canvas.getContext("2d");
  context.drawImage(image, -left * scale, -top * scale);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let place = 0; place < data.length; place += 4) {
    const [red, green, blue] = data.subarray(place, place + 3);
    if (Math.max(red, green, blue) - Math.min(red, green, blue) > 40) count += 1;
  }
  return (4 * count) / data.length;
}

test("Firefox draws the models and the deviation in its colours", { skip }, async (context) => {
  const without = await opened.evaluate(() => document.getElementById("tools").hidden);
  if (without) return context.skip("this Firefox has no WebGL");
  await done(select, "preset", "Experiments: two wavy sheets");
  const models = await opened.screenshot("firefox");
  assert.ok((await opened.evaluate(coloured, models)) > 0.05);
  await done(() => document.getElementById("deviation").click());
  assert.ok(await opened.evaluate(() => !document.getElementById("legend").hidden));
  // It is drawn on the next frame.
  await opened.evaluate(
    () => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))),
  );
  const deviation = await opened.screenshot("firefox-deviation");
  assert.notEqual(deviation, models);
  assert.ok((await opened.evaluate(coloured, deviation)) > 0.05);
  await done(() => document.getElementById("deviation").click());
});

test("Firefox measures concentric spheres by every method", { skip }, async () => {
  await done(select, "preset", "Concentric spheres");
  // One that is chosen already is not measured again.
  for (const method of ["iteration", "certified", "hierarchy"]) {
    await done(select, "method", method);
    const { lower, upper } = await result();
    const rounding = 1e-12;
    assert.ok(Number(lower) <= 0.2 + rounding && 0.2 - rounding <= Number(upper), method);
    const facts = await opened.evaluate(() => document.getElementById("facts").textContent);
    const webgpu = await opened.evaluate(
      async () => (await navigator.gpu?.requestAdapter()) ?? null,
    );
    if (webgpu === null) assert.match(facts, /on the CPU/, method);
  }
});

/** The largest error of the distances of many points from a torus, by two workers of the page's engine. */
async function inTwoWorkers(address) {
  const worker = new Worker(address, { type: "module" });
  const answers = new Map();
  worker.onmessage = ({ data }) => answers.get(data.id)(data);
  const call = (id, method, ...args) =>
    new Promise((resolve) => {
      answers.set(id, resolve);
      worker.postMessage({ id, method, args });
    });
  await call(1, "create", { backend: "cpu" }, { workers: 2 });
  const { result: model } = await call(2, "shape", "torus");
  const [outer, , tube] = model.boundingBox.max;
  // So many, all over the box, that the second worker begins while they are measured.
  const points = Float64Array.from(
    { length: 3 * 100_000 },
    (_, at) => outer * Math.sin(at * Math.sqrt(at % 3 === 2 ? 3 : 2)),
  );
  const { result, failure, engine } = await call(3, "closestPoints", 2, points, {});
  worker.terminate();
  const errors = result?.distances.map((distance, at) => {
    const [x, y, z] = points.subarray(3 * at, 3 * at + 3);
    const truth = Math.abs(Math.hypot(Math.hypot(x, y) - (outer - tube), z) - tube);
    return Math.abs(distance - truth);
  });
  const largest = errors?.reduce((one, other) => Math.max(one, other));
  return { failed: failure?.message ?? "", workers: engine?.workers, largest };
}

test("Firefox shares points out to two workers", { skip }, async () => {
  const engine = readdirSync(inRoot("www", "dist", "assets")).find((name) => /^engine-/.test(name));
  const { failed, workers, largest } = await opened.evaluate(inTwoWorkers, `assets/${engine}`);
  assert.deepEqual([failed, workers], ["", 2]);
  assert.ok(largest < 1e-8, `${largest}`);
});

test("Firefox opens a file", { skip }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "page-"));
  try {
    for (const [side, height] of [
      ["a", 0],
      ["b", 0.25],
    ]) {
      const file = join(folder, `${side}.json`);
      writeFileSync(file, JSON.stringify(planes(height)));
      await opened.evaluate(() => {
        document.getElementById("result").dataset.state = "awaited";
      });
      await opened.setFile(`#file-${side}`, file);
      await opened.until(() => document.getElementById("result").dataset.state === "done");
    }
    await done(select, "method", "certified");
    const { lower, upper } = await result();
    assert.ok(Number(lower) <= 0.25 && 0.25 <= Number(upper), `${lower} ${upper}`);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
