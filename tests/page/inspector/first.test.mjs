// What a newcomer sees: two brackets compared in colours, a verdict, places, and a report.
import assert from "node:assert/strict";
import { copyFileSync, readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { drawn } from "../support/drawn.mjs";
import { open } from "../support/open.mjs";

/** The base plate of the revision is longer by this, and the bores moved by the other. */
const LONGER = 0.35;
const MOVED = 0.3;

let opened;
let page;

before(async () => {
  opened = await open({ path: "" });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const text = (selector) => page.locator(selector).textContent();

/** Takes the README's picture, for `npm run picture`; narrower, which keeps the file small. */
async function takePicture(path) {
  const size = page.viewportSize();
  await page.setViewportSize({ width: 1130, height: 800 });
  await page.locator("#fit").click();
  await page.mouse.move(0, 0);
  await drawn(page);
  await page.screenshot({ path });
  await page.setViewportSize(size);
}

test("two brackets are compared at once, with a tolerance and in colours", async () => {
  const { lower, upper } = await opened.data();
  assert.ok(Number(lower) <= LONGER + 1e-9 && LONGER - 1e-9 <= Number(upper), `${lower} ${upper}`);
  assert.equal(await text("#badge"), "FAIL");
  assert.equal(await text("#unit"), "mm");
  assert.match(await text("#where"), /A base end, from B base end/);
  assert.ok(await page.locator("#legend").isVisible());
  assert.ok(await page.locator("#banner").isHidden());
  await opened.screenshot("first");
  if (process.env.PICTURE) await takePicture(process.env.PICTURE);
});

test("a file that cannot be read leaves the models, what is allowed and the verdict", async () => {
  const buffer = Buffer.from("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=PLANE('',#2);");
  await page.setInputFiles("#file-a", { name: "cut.step", mimeType: "text/plain", buffer });
  await page.getByText("STEP_SYNTAX").waitFor();
  assert.equal(await page.locator("#limit").inputValue(), "0.2");
  assert.equal(await text("#badge"), "FAIL");
});

test("the map holds the certified maximum of both models, and no number below its rounding", async () => {
  // Most of both brackets' faces agree to rounding.
  const statistics = await opened.texts("#statistics");
  assert.deepEqual([statistics["A: median"], statistics["B: median"]], ["≈ 0.000", "≈ 0.000"]);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#export-csv").click(),
  ]);
  const lines = readFileSync(await download.path(), "utf8")
    .trim()
    .split("\n")
    .slice(1);
  const rows = lines.map((line) => line.split(","));
  for (const side of ["A", "B"]) {
    const own = rows.filter(([of]) => of === side);
    const largest = Math.max(...own.map((row) => Number(row[8])));
    assert.ok(Math.abs(largest - LONGER) < 1e-8, `${side}: ${largest}`);
    // Inside the other one is negative: A's end is within B, and B's is outside A.
    const extreme = own.find((row) => Number(row[8]) === largest);
    assert.equal(Math.sign(Number(extreme[9])), side === "A" ? -1 : 1, side);
  }
  // Every bore of the base plate moved: it is among the places beyond what is allowed.
  const bore = rows.filter(([side, face]) => side === "A" && face === "10");
  const farthest = Math.max(...bore.map((row) => Number(row[8])));
  assert.ok(Math.abs(farthest - MOVED) < 1e-3, `${farthest}`);
});

test("the worst places are listed, and a key goes through them", async () => {
  const rows = page.locator("#place-list button");
  assert.match(await rows.first().textContent(), /base end.*0\.350/);
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  assert.equal(await rows.nth(0).getAttribute("aria-pressed"), "true");
  await page.keyboard.press("n");
  assert.equal(await rows.nth(1).getAttribute("aria-pressed"), "true");
  await page.locator("#label", { hasText: "0.350" }).waitFor();
});

test("a bin of the histogram shows where its deviations are", async () => {
  await page.locator("#histogram .target").last().dispatchEvent("click");
  await page.locator("#focus-clear").waitFor();
  await page.locator("#focus-clear").click();
  assert.ok(await page.locator("#focus-clear").isHidden());
});

test("allowed deviations of both signs decide by measured points", async () => {
  // Outwards 0.4 would do, but inwards A reaches 0.35.
  await page.locator("#limit").fill("0.4");
  assert.equal(await text("#badge"), "PASS");
  await page.locator("#limit-below").fill("0.1");
  assert.equal(await text("#badge"), "FAIL");
  assert.match(await text("#verdict"), /measured point is beyond/);
  // Less than the rounding of vertices in float32 is not certain.
  await page.locator("#limit-below").fill("0.349999");
  assert.equal(await text("#badge"), "UNDECIDED");
  await page.locator("#limit-below").fill("");
  await page.locator("#limit").fill("0.2");
});

test("a face is hidden, isolated and found by its name", async () => {
  await page.locator("#tree-filter").fill("bearing");
  const rows = page.locator("#tree-list li");
  assert.equal(await rows.count(), 2);
  await rows.first().locator('input[type="checkbox"]').uncheck();
  assert.ok(!(await rows.first().locator('input[type="checkbox"]').isChecked()));
  // The classes of a comparison are drawn without the hidden face.
  await page.locator("#compare").click();
  await page.locator('#faces[data-state="done"]').waitFor();
  await page.locator("#faces-clear").click();
  await page.locator("#tree-all").click();
  assert.ok(await rows.first().locator('input[type="checkbox"]').isChecked());
  await page.locator("#tree-filter").fill("");
  await page.locator("#tree-changed").check();
  const changed = await page.locator("#tree-list .name").allTextContents();
  assert.ok(changed.includes("base end") && !changed.includes("upright top"), changed.join());
  await page.locator("#tree-changed").uncheck();
});

test("a face has a limit of its own, in verdict, comparison, list and address", async () => {
  // The base end moved by 0.35, and every bore by 0.3: each is allowed of its face alone.
  const own = page.locator("#tree-list .own-limit");
  await page.locator("#tree-filter").fill("base end");
  assert.equal(await own.count(), 2);
  await own.first().fill("nonsense");
  await own.first().blur();
  assert.equal(await own.first().getAttribute("aria-invalid"), "true");
  await own.first().fill("+0.1/-0.4");
  await own.nth(1).fill("+0.4/-0.1");
  await own.nth(1).blur();
  // Of other faces no more than 0.2 is allowed: that a point of one is beyond is certain.
  assert.equal(await text("#badge"), "FAIL");
  assert.match(await text("#verdict"), /a measured point is beyond: [AB] /);
  assert.doesNotMatch(await text("#verdict"), /base end/);
  // Within on the side where more is allowed, which no interval proves.
  await page.locator("#limit").fill("0.37");
  assert.equal(await text("#badge"), "UNDECIDED");
  await own.first().fill("0.36");
  await own.nth(1).fill("0.36");
  await own.nth(1).blur();
  assert.equal(await text("#badge"), "PASS");
  await page.waitForFunction(() => location.hash.includes("own-limits="));
  // Less than the end moved by: its face fails again, and in the comparison it alone.
  await own.nth(1).fill("0.1");
  await own.nth(1).blur();
  assert.equal(await text("#badge"), "FAIL");
  assert.match(await text("#verdict"), /B base end/);
  await page.locator("#face-limit").fill("0.37");
  await page.locator("#compare").click();
  await page.locator('#faces[data-result="changed"]').waitFor();
  assert.deepEqual(await page.locator("#face-list .name").allTextContents(), ["base end"]);
  await page.locator("#faces-clear").click();
  await page.locator("#tree-filter").fill("");
  await page.locator("#limit").fill("0.2");
});

test("a section is capped, and its deviations are drawn along it", async () => {
  await page.selectOption("#section-axis", "1");
  await page.locator("#cut svg").waitFor();
  // Deviations are red and blue beside the contours.
  const painted = await page.locator("#cut canvas").evaluate((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const counts = { red: 0, blue: 0 };
    for (let at = 0; at < data.length; at += 4) {
      if (data[at + 3] < 255) continue;
      if (data[at] > 1.6 * data[at + 2]) counts.red += 1;
      if (data[at + 2] > 1.6 * data[at]) counts.blue += 1;
    }
    return counts;
  });
  assert.ok(painted.red > 100 && painted.blue > 100, JSON.stringify(painted));
  assert.match(await page.locator("#cut-plot").getAttribute("aria-label"), /80\.350+ × 70\.0+ mm/);
  // It is below the controls of the section.
  await page.waitForFunction(
    () =>
      document.getElementById("context").getBoundingClientRect().bottom <
      document.getElementById("cut").getBoundingClientRect().top,
  );
  // The base reaches from 0 to 80 mm in A, and to 0.35 more in B.
  const plot = await page.locator("#cut svg").boundingBox();
  // The upright 25 mm above the base's bottom, and the end of the base, from the middle of B, where the scene begins.
  const ends = await page.locator("#cut svg").evaluate((drawing) => {
    const matrix = drawing.getScreenCTM();
    const [right, bottom] = [80.35 / 2, 70 / 2];
    return [
      [-right, bottom - 25],
      [right, bottom],
    ].map(([x, y]) => {
      const point = new DOMPoint(x, y).matrixTransform(matrix);
      return [point.x, point.y];
    });
  });
  const measured = page.locator("#cut-measured");
  await page.mouse.move(plot.x + plot.width / 2, plot.y + plot.height - 2);
  assert.match(await measured.textContent(), /click two points/);
  await page.mouse.move(...ends[1]);
  assert.match(await measured.textContent(), /^[AB] ≈ [+−]0\.3500 mm$/);
  await page.mouse.click(...ends[1]);
  assert.match(await measured.textContent(), /second point/);
  await page.mouse.click(...ends[0]);
  // The ends of both are a pixel apart: which of them was picked is said.
  const text = await measured.textContent();
  const [, apart, from, across] = /≈ ([\d.]+) mm from ([AB]) to [AB] \(x −([\d.]+),/.exec(text);
  assert.equal(await page.locator("#cut svg circle").count(), 2);
  const reach = from === "A" ? 80 : 80.35;
  assert.ok(Math.abs(Number(across) - reach) < 1e-3, text);
  assert.ok(Number(apart) >= Number(across), text);
  await page.selectOption("#direction", "back");
  await opened.screenshot("first-section");
  await page.selectOption("#section-axis", "");
  await page.locator("#cut").waitFor({ state: "hidden" });
});

/** Counts the pixels of pictures that have the colour of marks. */
const marks = (pictures) =>
  pictures.map((picture) => {
    const canvas = new OffscreenCanvas(picture.naturalWidth, picture.naturalHeight);
    const context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let at = 0; at < data.length; at += 4) {
      const [r, g, b] = data.subarray(at, at + 3);
      if (Math.max(Math.abs(r - 207), Math.abs(g - 47), Math.abs(b - 75)) < 3) count += 1;
    }
    return count;
  });

test("the report has the verdict, views with legends, faces, and numbered axes", async () => {
  await page.locator("#report-part").fill("Bracket 7");
  await page.locator("#report-operator").fill("N. N.");
  for (const view of ["isometric", "front"]) {
    await page.selectOption("#direction", view);
    await page.locator("#add-view").click();
  }
  await page.locator("#view-count", { hasText: "2 views" }).waitFor();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#export-report").click(),
  ]);
  // As a file, which has to say itself how its text is encoded.
  const file = `${await download.path()}.html`;
  copyFileSync(await download.path(), file);
  const report = await page.context().browser().newPage();
  await report.goto(pathToFileURL(file).href);
  const all = await report.locator("body").innerText();
  for (const part of [
    "Bracket 7",
    "N. N.",
    "FAIL",
    "+0.2 / −0.2 mm",
    "base end",
    "0.36",
    "beyond",
  ]) {
    assert.ok(all.includes(part), part);
  }
  assert.equal(await report.locator(".view img").count(), 2);
  assert.equal(await report.locator(".view svg.legend").count(), 2);
  assert.equal(await report.locator(".places img").count(), 4);
  // In each the place is marked, in the middle, by a colour that no map has.
  for (const count of await report.locator(".places img").evaluateAll(marks)) {
    assert.ok(count > 30, `${count} pixels`);
  }
  assert.match(await report.locator("svg.histogram").textContent(), /%.*deviation/);
  // Words do not run together, and no element has an identifier of the page's twice.
  assert.doesNotMatch(all, /undefined|NaN/);
  await report.close();
});

test("the report opens in a tab of its own, with a button that prints all but itself", async () => {
  const [report] = await Promise.all([
    page.waitForEvent("popup"),
    page.locator("#export-pages").click(),
  ]);
  const print = report.getByRole("button", { name: "Print, or save as PDF" });
  await print.waitFor();
  assert.match(await report.locator("body").innerText(), /FAIL[\s\S]*\+0\.2 \/ −0\.2 mm/);
  await report.evaluate(() => {
    window.print = () => {
      window.printed = true;
    };
  });
  await print.click();
  assert.ok(await report.evaluate(() => window.printed));
  await report.emulateMedia({ media: "print" });
  assert.ok(await print.isHidden());
  await report.close();
});

test("where the browser opens no tab, the report is saved, and the page says so", async () => {
  await page.evaluate(() => {
    window.opensTabs = window.open;
    window.open = () => null;
  });
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#export-pages").click(),
  ]);
  assert.equal(download.suggestedFilename(), "hausdorff-report.html");
  await page.locator("#export-note", { hasText: "saved as a file" }).waitFor();
  await page.evaluate(() => {
    window.open = window.opensTabs;
  });
});

test("clearance mode lists the faces that meet, and ends", async () => {
  await page.locator("#clearance-start").click();
  await page.locator('#clearance[data-state="done"]').waitFor();
  assert.match(await text("#clearance-text"), /Touching|Clash/);
  assert.ok((await page.locator("#gap-list button").count()) > 0);
  assert.match(await text("#no-places"), /clearance is measured instead/);
  await page.locator("#move-x-exact").fill("100");
  await page.locator("#clearance-text", { hasText: "Apart by 20" }).waitFor();
  // No distance is shown of where A was before, and none is waited for with models that are new.
  assert.deepEqual([await text("#distance"), await text("#badge")], ["–", ""]);
  await page.selectOption("#preset", { index: 0 });
  await page.locator("#clearance-text", { hasText: "Clash" }).waitFor();
  assert.equal((await opened.data()).state, "paused");
  assert.ok(!(await page.locator("#work").isVisible()));
  await page.locator("#move-x-exact").fill("3");
  await page.locator('#clearance[data-state="done"]').waitFor();
  await opened.screenshot("first-clash");
  await opened.until("done", () => page.locator("#clearance-start").click());
  await opened.until("done", () => page.locator("#move-x-exact").fill("0"));
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
