// Radii and edges that are picked in the view: with mouse and keyboard, undone, in the address, the report, in inches.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { cylinder, modelFile } from "../support/models.mjs";
import { open, PLAIN } from "../support/open.mjs";
import { countPixels } from "../support/pixels.mjs";

let opened;
let page;

const MM = 1e-3;

before(async () => {
  opened = await open({ path: PLAIN });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
  // Of radius 2 and bored by radius 1.
  const tube = { unit: MM, ...cylinder({ bored: true }) };
  const files = ["a", "b"].map((name) => modelFile(`${name}.json`, tube));
  await opened.until("done", () => page.setInputFiles("#file-both", files));
  await page.selectOption("#direction", "front");
  await drawn(page);
});

after(() => opened.close());

const text = (selector) => page.locator(selector).textContent();
const rows = () => page.locator("#measure-list li");

/** Measures what is in the middle of the view by the keyboard alone. */
async function measureMiddle(what) {
  if (await page.locator("#measure-controls").isHidden()) {
    await page.locator("#canvas").focus();
    await page.keyboard.press("m");
  }
  await page.selectOption("#measure-what", what);
  await page.locator("#canvas").focus();
  await page.keyboard.press("Enter");
  await drawn(page);
}

/** The width and height of the view, in pixels. */
const viewSize = async () => {
  const { width, height } = await page.locator("#canvas").boundingBox();
  return [width, height];
};

/** Clicks on the view, at pixels from its middle. */
async function click(across, up) {
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  await page.mouse.click(x + width / 2 + across, y + height / 2 - up);
}

test("the radius of a cylinder is measured by the keyboard, and its interval holds it", async () => {
  await measureMiddle("radius");
  const said = await text("#measure-text");
  assert.match(said, /^R 2\.0+ mm · ⌀ 4\.0+ mm · cylinder · /);
  const [, lower, upper] = /certainly in \[([\d.]+), ([\d.]+)\]/.exec(said).map(Number);
  assert.ok(lower <= 2 && 2 <= upper && upper - lower < 1e-9, said);
  assert.match(await text("#label"), /^R 2\.0/);
  assert.equal(await rows().count(), 1);
  assert.equal(await page.locator(".pin").count(), 0);
  await opened.screenshot("radius");
});

test("the radius of a round edge of a plane face, and the length of that edge", async () => {
  await page.selectOption("#direction", "top");
  await drawn(page);
  // The ring is from radius 1 to 2; nearer to its inner edge, and to its outer one.
  const pixels = Math.min(...(await viewSize())) / 3;
  await click(pixels, 0);
  const inner = await text("#measure-text");
  const [, radius] = /^≈ R ([\d.]+) mm .* round edge/.exec(inner) ?? [];
  assert.ok(
    [1, 2].some((size) => Math.abs(radius - size) < 1e-4),
    inner,
  );
  await page.selectOption("#measure-what", "edge");
  await click(pixels, 0);
  const edge = await text("#measure-text");
  const [, length] = /^≈ ([\d.]+) mm long · arcs .* closed$/.exec(edge) ?? [];
  assert.ok(Math.abs(length - 2 * Math.PI * radius) < 1e-3, edge);
  assert.equal(await rows().count(), 3);
});

test("the mark of a first point goes when something else is measured", async () => {
  const marked = () => countPixels(page, "r > 180 && g < 90 && b < 120");
  await page.selectOption("#measure-what", "points");
  const before = await marked();
  await click(Math.min(...(await viewSize())) / 3, 0);
  await drawn(page);
  assert.ok((await marked()) > before, "a mark");
  await page.selectOption("#measure-what", "radius");
  await drawn(page);
  assert.equal(await marked(), 0);
});

test("a plane face without a round edge has no radius", async () => {
  const square = (name) =>
    modelFile(name, {
      unit: MM,
      surfaces: [
        {
          ...{ degree: [1, 1], knots_u: [0, 0, 1, 1], knots_v: [0, 0, 1, 1] },
          ctrl: [
            [
              [0, 0, 0, 1],
              [0, 30, 0, 1],
            ],
            [
              [50, 0, 0, 1],
              [50, 30, 0, 1],
            ],
          ],
        },
      ],
    });
  await opened.until("done", () =>
    page.setInputFiles("#file-both", [square("a.json"), square("b.json")]),
  );
  assert.equal(await rows().count(), 0, "the models are new");
  await page.selectOption("#direction", "top");
  await drawn(page);
  await measureMiddle("radius");
  assert.match(await text("#measure-text"), /^No cylinder/);
  assert.equal(await rows().count(), 0);
  // In the middle, the nearest edges are the long ones.
  await measureMiddle("edge");
  assert.match(await text("#measure-text"), /^≈ 50\.000\d* mm long · drawn edge/);
});

test("what was measured is undone and done again, is in the address and in inches", async () => {
  await page.waitForFunction(() => location.hash.includes("measures="));
  await page.locator("#undo").click();
  assert.equal(await rows().count(), 0);
  await page.locator("#redo").click();
  assert.equal(await rows().count(), 1);
  await page.keyboard.press("Escape");
  await opened.until("done", () => page.selectOption("#shown-unit", "0.0254"));
  await drawn(page);
  assert.match(await text("#measure-list li .look span"), /^≈ 1\.9685\d* in long/);
  await opened.until("done", () => page.selectOption("#shown-unit", ""));
  await drawn(page);
});

test("the report and the JSON have what was measured", async () => {
  const saved = async (id) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(id).click()]);
    return readFileSync(await download.path(), "utf8");
  };
  const { measures } = JSON.parse(await saved("#export-json"));
  assert.equal(measures.length, 1);
  assert.equal(measures[0].what, "edge");
  assert.match(measures[0].text, /^≈ 50\.000/);
  const report = await saved("#export-report");
  assert.match(report, /<h2>Measurements<\/h2>/);
  assert.match(report, /≈ 50\.000/);
});

test("a measurement is looked at and removed in the list", async () => {
  await page.locator("#measure-list .look").click();
  await drawn(page);
  assert.match(await text("#label"), /^≈ 50\.000/);
  await opened.screenshot("measurements");
  await page.getByRole("button", { name: "Remove measurement 1" }).click();
  assert.equal(await rows().count(), 0);
  assert.ok(await page.locator("#measures-empty").isVisible());
});

test("what an address says of measurements is checked", async () => {
  for (const value of ["[", "7", '[["edge"]]', '[["edge",["c",0,0,0,0,0,0,1]]]', '[["x",7]]']) {
    await page.evaluate((wanted) => {
      const control = document.querySelector("[name=measures]");
      control.value = wanted;
      control.dispatchEvent(new Event("input", { bubbles: true }));
    }, value);
    assert.equal(await rows().count(), 0, value);
  }
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
