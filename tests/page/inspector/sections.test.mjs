// Sections by any normal: as the user looks, along a face, with offset and tilt.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { cube, modelFile } from "../support/models.mjs";
import { open } from "../support/open.mjs";
import { countPixels } from "../support/pixels.mjs";

let opened;
let page;

before(async () => {
  // The view is about 910 × 800 pixels beside the panels.
  opened = await open({ path: "", size: { width: 1530, height: 848 } });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** Where the models of the example begin and end along x. */
const [LOWEST, LONGEST] = [0, 80.35];

/** What the plot says of itself. */
const said = () => page.locator("#cut-plot").getAttribute("aria-label");

/** Fails unless the contour is as wide and as high as this. */
async function reaches(width, height) {
  const [, ...size] = /The section, ([\d.]+) × ([\d.]+),? /.exec(await said()).map(Number);
  for (const [index, expected] of [width, height].entries()) {
    assert.ok(Math.abs(size[index] - expected) < 1e-4, `${size}, expected ${[width, height]}`);
  }
}

/** A cube of side 2 in one of side 3: only the inner one is painted, and cut. */
async function openCubes() {
  for (const [side, half] of [
    ["a", 1],
    ["b", 1.5],
  ]) {
    await opened.until("done", () =>
      page.setInputFiles(`#file-${side}`, modelFile(`${side}.json`, cube(half))),
    );
  }
  await opened.until("done", () => page.selectOption("#paint", "a"));
}

const values = async (...ids) =>
  Promise.all(ids.map((id) => page.locator(`#section-${id}`).inputValue()));

test("a free section faces the user, is in the link, and is undone", async () => {
  await page.locator("#limit").fill("1");
  await page.selectOption("#direction", "isometric");
  await page.selectOption("#show-b", "hidden");
  // The ground of the cap's hatching, which nothing else has.
  const ground = "Math.abs(r - 0xcd) < 4 && Math.abs(g - 0xd3) < 4 && Math.abs(b - 0xd9) < 4";
  const without = await countPixels(page, ground);
  await page.selectOption("#section-axis", "free");
  await page.locator("#cut svg").waitFor();
  const capped = await countPixels(page, ground);
  assert.ok(capped > without + 3000, `${capped} after ${without}`);
  await opened.screenshot("section-free");
  await page.locator("#section-tilt").fill("10");
  await page.waitForFunction(() => location.hash.includes("section-tilt=10"));
  const [before, contour] = [await values("axis", "at", "free", "tilt"), await said()];
  assert.equal(before[0], "free");
  await page.goto(`${page.url().replace(/#.*/, "?again")}${new URL(page.url()).hash}`);
  await page.locator('#result[data-state="done"]').waitFor();
  await page.locator("#cut svg").waitFor();
  assert.deepEqual(await values("axis", "at", "free", "tilt"), before);
  assert.equal(await said(), contour);
  await page.locator("#section-flip").check();
  await page.waitForFunction(() => location.hash.includes("section-flip=on"));
  await page.locator("#canvas").focus();
  await page.keyboard.press("Control+z");
  assert.equal(await page.locator("#section-flip").isChecked(), false);
  assert.deepEqual(await values("axis", "at", "free", "tilt"), before);
});

test("a view for the report says by which plane it is cut", async () => {
  await page.locator("#add-view").click();
  await page.locator("#view-count", { hasText: "1 view" }).waitFor();
  await page.selectOption("#section-axis", "0");
  await page.locator("#section-at").fill("0.5");
  await page.locator("#add-view").click();
  await page.locator("#view-count", { hasText: "2 views" }).waitFor();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#export-report").click(),
  ]);
  const report = readFileSync(await download.path(), "utf8");
  assert.match(report, /section by the normal \([^()]+\) through \([^()]+\)/);
  // The second one is straight again, in the middle of both.
  const [, at] = /section at x = ([\d.]+)/.exec(report) ?? [];
  assert.equal(Number(at), (LOWEST + LONGEST) / 2);
  await page.selectOption("#section-axis", "");
});

test("the middle of a cube across its diagonal is a hexagon, whose sides are measured", async () => {
  await openCubes();
  await page.selectOption("#direction", "isometric");
  await page.selectOption("#section-axis", "free");
  await page.locator("#section-view").click();
  await page.locator("#section-offset").fill("0");
  await page.locator("#section-offset").blur();
  await page.locator("#cut svg").waitFor();
  // Its corners to the left and right are √2 from the middle, and its sides √(3/2) above and below.
  await reaches(2 * Math.SQRT2, 2 * Math.sqrt(1.5));
  const corners = await page.locator("#cut svg").evaluate((drawing, away) => {
    const matrix = drawing.getScreenCTM();
    return [-away, away].map((x) => {
      const point = new DOMPoint(x, 0).matrixTransform(matrix);
      return { x: point.x, y: point.y };
    });
  }, Math.SQRT2);
  for (const { x, y } of corners) await page.mouse.click(x, y);
  // Opposite corners, in the plane's own directions.
  const text = await page.locator("#cut-measured").textContent();
  const [, apart] = /≈ ([\d.]+).* from A to A \(across [+−][\d.]+, up/.exec(text) ?? [];
  assert.ok(Math.abs(Number(apart) - 2 * Math.SQRT2) < 2e-3, text);
});

test("a section that is tilted by 45° is longer by √2, about either direction", async () => {
  await page.selectOption("#direction", "front");
  await page.locator("#section-view").click();
  await page.locator("#section-offset").fill("0");
  await page.locator("#section-offset").blur();
  await reaches(2, 2);
  await page.locator("#section-tilt").fill("45");
  await reaches(2, 2 * Math.SQRT2);
  await page.locator("#section-tilt").fill("0");
  await page.locator("#section-turn").fill("-45");
  await reaches(2 * Math.SQRT2, 2);
  await page.locator("#section-turn").fill("0");
  // Those along axes are tilted too.
  await page.locator("#section-turn").fill("30");
  await page.selectOption("#section-axis", "2");
  assert.deepEqual(await values("tilt", "turn"), ["0", "0"]);
  await page.locator("#section-tilt").fill("45");
  await reaches(2, 2 * Math.SQRT2);
  await page.locator("#section-tilt").fill("0");
});

test("a section along a face that is clicked is moved by an exact offset", async () => {
  await page.selectOption("#section-axis", "");
  await page.selectOption("#direction", "top");
  await drawn(page);
  await page.selectOption("#section-axis", "0");
  await page.locator("#section-at").fill("1");
  const face = page.locator("#section-face");
  await face.click();
  await page.keyboard.press("Escape");
  assert.equal(await face.getAttribute("aria-pressed"), "false");
  await face.click();
  assert.equal(await face.getAttribute("aria-pressed"), "true");
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  // Beside the models there is nothing to cut by.
  await page.mouse.click(x + width - 40, y + height / 2);
  assert.equal(await face.getAttribute("aria-pressed"), "true");
  await page.mouse.click(x + width / 2 + 20, y + height / 2);
  await page.waitForFunction(() => document.getElementById("section-axis").value === "free");
  assert.equal(await face.getAttribute("aria-pressed"), "false");
  assert.equal(await page.locator("#pins > *").count(), 0);
  // The inner cube's top: the outer one is seen through.
  const [normal, point] = [
    (await page.locator("#section-free").inputValue()).split(",").map(Number),
  ].flatMap((numbers) => [numbers.slice(0, 3), numbers.slice(3)]);
  assert.ok(Math.hypot(normal[0], normal[1], normal[2] - 1) < 1e-6, `${normal}`);
  assert.ok(Math.abs(point[2] - 1) < 1e-6, `${point}`);
  // Just beneath the face it is as large as the cube; a quarter of the cube further it is too.
  await reaches(2, 2);
  await page.locator("#section-offset").fill("-0.5");
  await page.locator("#section-offset").blur();
  await reaches(2, 2);
  assert.ok(Math.abs(Number((await values("at"))[0]) - (0.5 + 1.5) / 3) < 1e-6);
  // Above the inner cube there is nothing to plot.
  await page.locator("#section-offset").fill("0.25");
  await page.locator("#section-offset").blur();
  await page.locator("#cut").waitFor({ state: "hidden" });
  await opened.screenshot("section-face");
  await page.selectOption("#section-axis", "");
});

test("what an address says of a section is checked", async () => {
  for (const free of ["", "1,2", "0,0,0,1,2,3", "a,b,c,d,e,f", "1,0,0,1e999,0,0"]) {
    await page.goto(
      `${page.url().replace(/[?#].*/, `?${encodeURIComponent(free)}`)}#a=fig5-plane&b=fig5-cylinder&symmetric=&section=free&section-free=${free}&section-tilt=x&section-turn=1e9`,
    );
    await page.locator('#result[data-state="done"]').waitFor();
    assert.match(await page.locator("#distance").textContent(), /\d/);
  }
});

test("a cut is capped whichever way the faces are oriented", async () => {
  const oriented = cube(1);
  // Normals of the faces at -1 along each axis: outwards as well.
  for (const face of oriented.surfaces.filter((_, index) => index % 2 === 0)) {
    face.ctrl = [0, 1].map((row) => [0, 1].map((column) => face.ctrl[column][row]));
  }
  const counts = [];
  for (const model of [cube(1), oriented]) {
    for (const [side, content] of Object.entries({ a: model, b: cube(1.5) })) {
      await opened.until("done", () =>
        page.setInputFiles(`#file-${side}`, modelFile(`${side}.json`, content)),
      );
    }
    await page.selectOption("#show-b", "hidden");
    await page.selectOption("#direction", "isometric");
    await page.selectOption("#section-axis", "0");
    await page.locator("#cut svg").waitFor();
    const ground = "Math.abs(r - 0xcd) < 4 && Math.abs(g - 0xd3) < 4 && Math.abs(b - 0xd9) < 4";
    counts.push(await countPixels(page, ground));
    await page.selectOption("#section-axis", "");
  }
  const [either, outwards] = counts;
  assert.ok(outwards > 3000 && Math.abs(either - outwards) < 0.01 * outwards, `${counts}`);
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
